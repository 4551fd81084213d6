#include "content/demo/play/play_clock.h"

#include <utility>

namespace rowland::demo {

namespace {

bool is_release(const PlayEvent& event) {
    const auto* input = std::get_if<platform::InputEvent>(&event);
    const auto* button = input == nullptr ? nullptr : std::get_if<platform::MouseButtonEvent>(input);
    return button != nullptr && !button->down;
}

}  // namespace

std::span<const PlayEvent> events_of_step(std::span<const PlayEvent> events, int step, int steps) {
    const auto n = static_cast<std::size_t>(steps);
    // Event i falls on step floor(i steps / events).
    const auto begin_of = [&](std::size_t s) {
        std::size_t begin = (events.size() * s + n - 1) / n;
        while (begin > 0 && begin < events.size() && is_release(events[begin])) ++begin;
        return begin;
    };
    const std::size_t begin = begin_of(static_cast<std::size_t>(step));
    return events.subspan(begin, begin_of(static_cast<std::size_t>(step) + 1) - begin);
}

void PlayClock::live(Play& play, std::chrono::nanoseconds frame, std::vector<PlayEvent> events, Recorder* recorder) {
    std::erase_if(events, [this](const PlayEvent& event) { return is_unchanged_pad(event); });
    waiting_.insert(waiting_.end(), events.begin(), events.end());
    const int steps = pace_.advance(frame);
    for (int i = 0; i < steps; ++i) {
        const std::span<const PlayEvent> of_step = events_of_step(waiting_, i, steps);
        if (recorder != nullptr) recorder->add(play.steps(), of_step);
        play.step(of_step);
    }
    if (steps > 0) waiting_.clear();
    if (recorder != nullptr) recorder->flush();
}

bool PlayClock::is_unchanged_pad(const PlayEvent& event) {
    const auto* input = std::get_if<platform::InputEvent>(&event);
    const auto* pad = input == nullptr ? nullptr : std::get_if<platform::GamepadEvent>(input);
    if (pad == nullptr) return false;
    const platform::GamepadEvent before = std::exchange(pad_, *pad);
    return pad_.connected == before.connected && pad_.axes == before.axes && pad_.buttons == before.buttons;
}

bool PlayClock::replay(Play& play, std::chrono::nanoseconds frame, const Recording& recording) {
    for (int steps = pace_.advance(frame); steps > 0 && play.steps() < recording.step_count; --steps)
        play.step(recording.events_at(play.steps()));
    return play.steps() < recording.step_count;
}

}  // namespace rowland::demo

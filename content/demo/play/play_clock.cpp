#include "content/demo/play/play_clock.h"

#include <iterator>
#include <utility>

namespace rowland::demo {

void PlayClock::live(Play& play, std::chrono::nanoseconds frame, std::vector<PlayEvent> events, Recorder* recorder) {
    waiting_.insert(waiting_.end(), std::make_move_iterator(events.begin()), std::make_move_iterator(events.end()));
    const int steps = pace_.advance(frame);
    for (int i = 0; i < steps; ++i) {
        const std::span<const PlayEvent> of_step = events_of_step(waiting_, i, steps);
        if (recorder != nullptr) recorder->add(play.steps(), of_step);
        play.step(of_step);
    }
    if (steps > 0) waiting_.clear();
    if (recorder != nullptr) recorder->flush();
}

bool PlayClock::replay(Play& play, std::chrono::nanoseconds frame, const Recording& recording) {
    for (int steps = pace_.advance(frame); steps > 0 && play.steps() < recording.step_count; --steps)
        play.step(recording.events_at(play.steps()));
    return play.steps() < recording.step_count;
}

}  // namespace rowland::demo

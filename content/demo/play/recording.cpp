#include "content/demo/play/recording.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "content/demo/play/play.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/core/text.h"
#include "engine/platform/input.h"

namespace rowland::demo {

namespace {

using nlohmann::ordered_json;

constexpr int kVersion = 1;
constexpr std::uint64_t kLargestFile = std::uint64_t{1} << 30;
constexpr std::int64_t kMostSteps = std::int64_t{kStepsPerSecond} * 86400 * 7;  ///< a week
constexpr int kLargestWindow = 65536;
constexpr double kFarthest = 1e7;  ///< screen coordinates and notches

constexpr std::array<std::string_view, 3> kButtons{"left", "right", "middle"};

ordered_json line_of(const platform::InputEvent& event, std::uint64_t step) {
    ordered_json line{{"step", step}};
    std::visit(
        [&line](const auto& e) {
            using E = std::decay_t<decltype(e)>;
            if constexpr (std::is_same_v<E, platform::KeyEvent>) {
                line["key"] = platform::name_of(e.key);
                line["down"] = e.down;
            } else if constexpr (std::is_same_v<E, platform::MouseButtonEvent>) {
                line["button"] = kButtons[static_cast<std::size_t>(e.button)];
                line["down"] = e.down;
            } else if constexpr (std::is_same_v<E, platform::MouseMoveEvent>) {
                line["mouse"] = {e.position.x, e.position.y};
            } else if constexpr (std::is_same_v<E, platform::ScrollEvent>) {
                line["scroll"] = {e.offset.x, e.offset.y};
            } else if constexpr (std::is_same_v<E, platform::FocusEvent>) {
                line["focused"] = e.focused;
            } else if constexpr (std::is_same_v<E, platform::CursorCaptureEvent>) {
                line["captured"] = e.captured;
            } else if constexpr (std::is_same_v<E, platform::GamepadEvent>) {
                line["pad"] = {{"connected", e.connected}, {"axes", e.axes}, {"buttons", e.buttons}};
            } else {
                static_assert(std::is_same_v<E, platform::CharEvent>);
                line = nullptr;
            }
        },
        event);
    return line;
}

ordered_json line_of(const ResizeEvent& event, std::uint64_t step) {
    return {{"step", step}, {"window", {event.size.x, event.size.y}}};
}

ordered_json line_of(const ActionEvent& event, std::uint64_t step) {
    return {{"step", step}, {"action", key_row(event.action).name}};
}

ordered_json line_of(const SettingEvent& event, std::uint64_t step) {
    ordered_json line{{"step", step}, {"set", kind_of(event.setting).name}};
    if (!event.object.empty()) line["of"] = valid_utf8(event.object);
    if (const auto* number = std::get_if<double>(&event.value))
        line["to"] = *number;
    else
        line["to"] = valid_utf8(std::get<std::string>(event.value));
    return line;
}

/// A required truth value.
bool truth(JsonReader& reader, const std::string& key) {
    if (!reader.has(key)) reader.fail(key, "nothing", "true or false");
    return reader.boolean_or(key, false);
}

glm::dvec2 pair(JsonReader& reader, const std::string& key) {
    const std::vector<double> numbers = reader.numbers(key, 2, {-kFarthest, kFarthest});
    return {numbers[0], numbers[1]};
}

glm::ivec2 window_size(JsonReader& reader) {
    const std::vector<double> numbers = reader.numbers("window", 2, {1, kLargestWindow});
    for (const double number : numbers)
        if (number != std::floor(number)) reader.fail("window", fmt::format("{}", number), "whole numbers");
    return {static_cast<int>(numbers[0]), static_cast<int>(numbers[1])};
}

platform::GamepadEvent pad_of(JsonReader reader) {
    platform::GamepadEvent pad{.connected = truth(reader, "connected"), .axes = {}, .buttons = {}};
    const std::vector<double> axes = reader.numbers("axes", pad.axes.size(), {-1, 1});
    std::transform(axes.begin(), axes.end(), pad.axes.begin(), [](double axis) { return static_cast<float>(axis); });
    const nlohmann::json& buttons = reader.raw("buttons");
    if (!buttons.is_array() || buttons.size() != pad.buttons.size() ||
        !std::all_of(buttons.begin(), buttons.end(), [](const auto& button) { return button.is_boolean(); }))
        reader.fail("buttons", buttons.dump(), fmt::format("{} times true or false", pad.buttons.size()));
    std::copy(buttons.begin(), buttons.end(), pad.buttons.begin());
    reader.finish();
    return pad;
}

PlayEvent key_event(JsonReader& reader) {
    const std::string name = reader.text("key");
    const auto key = platform::key_named(name);
    if (!key) reader.fail("key", name, "a key, as \"Space\" or \"F5\"");
    return platform::InputEvent(platform::KeyEvent{*key, truth(reader, "down")});
}

PlayEvent button_event(JsonReader& reader) {
    const std::string name = reader.choice("button", {kButtons[0], kButtons[1], kButtons[2]});
    const auto index = std::find(kButtons.begin(), kButtons.end(), name) - kButtons.begin();
    return platform::InputEvent(
        platform::MouseButtonEvent{static_cast<platform::MouseButton>(index), truth(reader, "down")});
}

PlayEvent action_event(JsonReader& reader) {
    const std::string name = reader.text("action");
    const auto action = find_action(name);
    if (!action) reader.fail("action", name, "an action, as \"pause\"");
    return ActionEvent{*action};
}

PlayEvent setting_event(JsonReader& reader) {
    const std::string name = reader.text("set");
    const auto setting = setting_named(name);
    if (!setting) reader.fail("set", name, "a setting, as \"exposure\"");
    SettingEvent event{.setting = *setting, .value = {}};
    if (const auto& range = kind_of(*setting).range)
        event.value = reader.number("to", {range->minimum, range->maximum});
    else
        event.value = reader.text("to");
    if (reader.has("of")) event.object = reader.text("of");
    return event;
}

PlayEvent event_of(JsonReader& reader) {
    if (reader.has("key")) return key_event(reader);
    if (reader.has("button")) return button_event(reader);
    if (reader.has("mouse")) return platform::InputEvent(platform::MouseMoveEvent{pair(reader, "mouse")});
    if (reader.has("scroll")) return platform::InputEvent(platform::ScrollEvent{pair(reader, "scroll")});
    if (reader.has("focused")) return platform::InputEvent(platform::FocusEvent{truth(reader, "focused")});
    if (reader.has("captured")) return platform::InputEvent(platform::CursorCaptureEvent{truth(reader, "captured")});
    if (reader.has("pad")) return platform::InputEvent(pad_of(reader.object("pad")));
    if (reader.has("window")) return ResizeEvent{window_size(reader)};
    if (reader.has("action")) return action_event(reader);
    if (reader.has("set")) return setting_event(reader);
    reader.fail("", "no event", "key, button, mouse, scroll, focused, captured, pad, window, action, set or end");
}

RecordingHead head_of(const nlohmann::json& line, const std::string& file) {
    if (!line.is_object() || !line.contains("rowland_play"))
        refuse_input(file, "line 1", "something else", "a recorded play", "make one with --record FILE");
    JsonReader reader(line, file);
    if (const std::int64_t version = reader.integer("rowland_play", 0, std::numeric_limits<std::int64_t>::max());
        version != kVersion)
        refuse_input(file, "line 1", fmt::format("version {}", version), fmt::format("version {}", kVersion),
                     "record it again with --record FILE");
    if (const std::int64_t rate = reader.integer("steps_per_second", 1, 1'000'000); rate != kStepsPerSecond)
        refuse_input(file, "line 1", fmt::format("{} steps per second", rate), fmt::format("{}", kStepsPerSecond),
                     "record it again with --record FILE");
    RecordingHead head{.scene = reader.text("scene"), .window = window_size(reader)};
    reader.finish();
    return head;
}

/// Reads line by line, so that messages can name the line.
class Reading {
 public:
    Reading(std::string text, std::string file) : text_(std::move(text)), file_(std::move(file)) {}

    Recording read() {
        Recording recording;
        nlohmann::json line;
        if (!next(line))
            refuse_input(file_, "line 1", "an empty file", "a recorded play", "make one with --record FILE");
        recording.head = head_of(line, file_);
        while (next(line)) add(recording, line);
        return recording;
    }

 private:
    std::string where() const { return fmt::format("{}: line {}", file_, number_); }

    bool next(nlohmann::json& line) {
        if (at_ == text_.size()) return false;
        const std::size_t end = text_.find('\n', at_);
        ++number_;
        if (end == std::string::npos)
            refuse_input(file_, fmt::format("line {}", number_), "a line without an end", "a whole line",
                         "remove the last line if writing it was cut off");
        line = parse_json(std::string_view(text_).substr(at_, end - at_), where());
        at_ = end + 1;
        return true;
    }

    void add(Recording& recording, const nlohmann::json& line) {
        if (ended_) refuse_input(file_, fmt::format("line {}", number_), "another line", "nothing after the end");
        JsonReader reader(line, where());
        const auto step = static_cast<std::uint64_t>(reader.integer("step", 0, kMostSteps));
        if (!recording.steps.empty() && step < recording.steps.back().step)
            reader.fail("step", fmt::format("{}", step), fmt::format("{} or later", recording.steps.back().step));
        if (reader.has("end")) {
            ended_ = true;
            (void)truth(reader, "end");
            recording.step_count = std::max(recording.step_count, step);
        } else {
            if (recording.steps.empty() || recording.steps.back().step != step) recording.steps.push_back({step, {}});
            recording.steps.back().events.push_back(event_of(reader));
            recording.step_count = step + 1;
        }
        reader.finish();
    }

    std::string text_;
    std::string file_;
    std::size_t at_ = 0;
    int number_ = 0;
    bool ended_ = false;
};

}  // namespace

Recorder::Recorder(const std::filesystem::path& path, const RecordingHead& head) : path_(path) {
    if (path.has_parent_path()) {
        std::error_code ignored;  // opening the file reports it
        std::filesystem::create_directories(path.parent_path(), ignored);
    }
    file_.open(path, std::ios::binary | std::ios::trunc);
    file_ << ordered_json{{"rowland_play", kVersion},
                          {"steps_per_second", kStepsPerSecond},
                          {"scene", head.scene},
                          {"window", {head.window.x, head.window.y}}}
                 .dump()
          << '\n';
    flush();
}

void Recorder::add(std::uint64_t step, std::span<const PlayEvent> events) {
    for (const PlayEvent& event : events) {
        const ordered_json line = std::visit([step](const auto& e) { return line_of(e, step); }, event);
        if (!line.is_null()) file_ << line.dump() << '\n';
    }
}

void Recorder::flush() {
    file_.flush();
    if (!file_) fail_system(path_.string(), "the recording could not be written", "make room, or name another file");
}

void Recorder::finish(std::uint64_t steps) {
    file_ << ordered_json{{"step", steps}, {"end", true}}.dump() << '\n';
    flush();
}

std::span<const PlayEvent> Recording::events_at(std::uint64_t step) const {
    const auto found =
        std::lower_bound(steps.begin(), steps.end(), step, [](const Step& s, std::uint64_t at) { return s.step < at; });
    return found != steps.end() && found->step == step ? std::span<const PlayEvent>(found->events)
                                                       : std::span<const PlayEvent>();
}

Recording parse_recording(std::string text, const std::string& file) {
    return Reading(std::move(text), file).read();
}

Recording load_recording(const std::filesystem::path& path) {
    return parse_recording(read_text_file(path, kLargestFile), path.string());
}

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

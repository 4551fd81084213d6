#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "content/demo/play/action.h"
#include "content/demo/play/play.h"
#include "engine/platform/frame_pacing.h"

namespace rowland::demo {

/// The conditions of a recording, which a playback must repeat.
struct RecordingHead {
    std::string scene;     ///< the name of what was shown
    glm::ivec2 window{1};  ///< screen coordinates at the start
};

/// Writes a play as it happens, in JSON lines: a head, then one event per line with its step. A program that crashes
/// leaves a recording up to its last frame. Typed text is not recorded.
class Recorder {
 public:
    /// Throws Error (system) if the file cannot be written.
    Recorder(const std::filesystem::path& path, const RecordingHead& head);
    /// The events of a step; steps must not decrease.
    void add(std::uint64_t step, std::span<const PlayEvent> events);
    /// Writes all lines so far. Throws Error (system) if the disk is full.
    void flush();
    /// Writes the last line, the number of steps. Throws as flush().
    void finish(std::uint64_t steps);

 private:
    std::filesystem::path path_;
    std::ofstream file_;
};

struct Recording {
    struct Step {
        std::uint64_t step = 0;
        std::vector<PlayEvent> events;
    };

    RecordingHead head;
    std::vector<Step> steps;       ///< those with events, in order
    std::uint64_t step_count = 0;  ///< of the whole play

    /// The events of one step; empty if it has none.
    std::span<const PlayEvent> events_at(std::uint64_t step) const;
};

/// Throws Error (input) that names `file` and the line if the text is no recording, of another version or damaged.
Recording parse_recording(std::string text, const std::string& file);
Recording load_recording(const std::filesystem::path& path);

/// Distributes a frame's events over its steps, evenly and in order, the first on the first; returns those of step
/// `step` of `steps`. The release of a mouse button stays with the event before it, so that a drag across a long frame
/// keeps about its speed to its end.
std::span<const PlayEvent> events_of_step(std::span<const PlayEvent> events, int step, int steps);

/// Divides frames into the steps of a play.
class PlayClock {
 public:
    /// Advances the play by a frame of that length in which `events` happened. Events of a frame shorter than a step
    /// wait for the next frame; unchanged game pad readings are dropped. What the play gets goes to `recorder` too, if
    /// there is one.
    void live(Play& play, std::chrono::nanoseconds frame, std::vector<PlayEvent> events, Recorder* recorder);

    /// Advances the play, which began with the recording, by a frame of that length; false once the recording is over.
    bool replay(Play& play, std::chrono::nanoseconds frame, const Recording& recording);

 private:
    bool is_unchanged_pad(const PlayEvent& event);

    // Longer frames are cut to a second: a drag keeps its speed down to one frame per second.
    platform::FixedStep pace_{kStepsPerSecond, std::chrono::seconds(1)};
    std::vector<PlayEvent> waiting_;
    platform::GamepadEvent pad_;  ///< as last read
};

}  // namespace rowland::demo

#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "content/demo/play/play_event.h"

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
    /// Writes the last line: the number of steps.
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

    /// Of one step.
    std::span<const PlayEvent> events_at(std::uint64_t step) const;
};

/// Throws Error (input) that names `file` and the line if the text is no recording, of another version or damaged.
Recording parse_recording(std::string text, const std::string& file);
Recording load_recording(const std::filesystem::path& path);

}  // namespace rowland::demo

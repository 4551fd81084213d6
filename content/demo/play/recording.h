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

/// What a recording was made with: played otherwise, its events would mean something else.
struct RecordingHead {
    std::string scene;     ///< the name of what was shown
    glm::ivec2 window{1};  ///< screen coordinates at the start
};

/// Writes a play as it happens: JSON lines, a head and then one event a line with the step it fell on. A program that
/// dies leaves a recording up to its last frame. What is typed as text is not recorded.
class Recorder {
 public:
    /// Throws Error (system) if the file cannot be written.
    Recorder(const std::filesystem::path& path, const RecordingHead& head);
    /// The events of a step; steps never go back.
    void add(std::uint64_t step, std::span<const PlayEvent> events);
    /// Hands all lines so far to the system. Throws Error (system) if it takes no more.
    void flush();
    /// The last line: how many steps the play had.
    void finish(std::uint64_t steps);

 private:
    std::filesystem::path path_;
    std::ofstream file_;
};

/// A recorded play.
struct Recording {
    struct Step {
        std::uint64_t step = 0;
        std::vector<PlayEvent> events;
    };

    RecordingHead head;
    std::vector<Step> steps;       ///< those with events, in order
    std::uint64_t step_count = 0;  ///< of the whole play

    /// Those of one step; none if nothing happened.
    std::span<const PlayEvent> events_at(std::uint64_t step) const;
};

/// Throws Error (input) that names `file` and the line if the text is none, of another version or damaged.
Recording parse_recording(std::string text, const std::string& file);
Recording load_recording(const std::filesystem::path& path);

}  // namespace rowland::demo

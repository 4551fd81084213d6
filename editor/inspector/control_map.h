#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace rowland::inspector {

/// Writes the rectangles of the last frame's controls, by name, to a file, for programs that drive the inspector
/// (tests, screen readers). Does nothing without a file.
class ControlMap {
 public:
    explicit ControlMap(std::optional<std::filesystem::path> file) : file_(std::move(file)) {}

    /// Adds ImGui's last control.
    void mark(const std::string& name);
    /// Adds a fact.
    void note(const std::string& name, const std::string& value);
    /// Writes the file if it changed, and the number of frames to a file of the same name with ".frames": two frames
    /// after an input the program has seen it.
    void end_frame();

 private:
    std::optional<std::filesystem::path> file_;
    std::map<std::string, std::string> entries_;
    std::string written_;
    std::uint64_t frames_ = 0;
};

}  // namespace rowland::inspector

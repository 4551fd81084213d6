#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace rowland::inspector {

/// Where the controls of the last frame are, by name, written to a file for those who drive the program from outside
/// (tests, screen readers). Does nothing without a file.
class ControlMap {
 public:
    explicit ControlMap(std::optional<std::filesystem::path> file) : file_(std::move(file)) {}

    /// The control that ImGui was last told of.
    void mark(const std::string& name);
    void mark(const std::string& name, float left, float top, float right, float bottom);
    /// A fact beside the places.
    void note(const std::string& name, const std::string& value);
    /// Writes what has changed since the last frame, and, to a file of the same name with ".frames", how many frames
    /// there were: who waits for two more knows that the program has seen what they did.
    void end_frame();

 private:
    std::optional<std::filesystem::path> file_;
    std::map<std::string, std::string> entries_;
    std::string written_;
    std::uint64_t frames_ = 0;
};

}  // namespace rowland::inspector

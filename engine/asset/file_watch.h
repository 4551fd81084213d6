#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace rowland::asset {

/// Detects when one of a set of files is written, created or removed, by its time and size.
class FileWatch {
 public:
    FileWatch() = default;
    /// Watches from now on. A file written at or after `since`, perhaps while it was being read, counts as changed.
    FileWatch(std::vector<std::filesystem::path> files, std::filesystem::file_time_type since);
    explicit FileWatch(std::vector<std::filesystem::path> files)
        : FileWatch(std::move(files), std::filesystem::file_time_type::max()) {}

    /// Whether a file has changed since the last call.
    bool changed();
    const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
    struct Stamp {
        std::filesystem::file_time_type time;
        std::uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };
    static std::optional<Stamp> stamp(const std::filesystem::path& file);

    std::vector<std::filesystem::path> files_;
    std::vector<std::optional<Stamp>> stamps_;
    bool written_since_ = false;
};

}  // namespace rowland::asset

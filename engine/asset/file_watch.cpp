#include "engine/asset/file_watch.h"

#include <algorithm>
#include <system_error>

namespace rowland::asset {

FileWatch::FileWatch(std::vector<std::filesystem::path> files, std::filesystem::file_time_type since)
    : files_(std::move(files)) {
    std::sort(files_.begin(), files_.end());
    files_.erase(std::unique(files_.begin(), files_.end()), files_.end());
    for (const std::filesystem::path& file : files_) {
        stamps_.push_back(stamp(file));
        if (stamps_.back() && stamps_.back()->time >= since) written_since_ = true;
    }
}

std::optional<FileWatch::Stamp> FileWatch::stamp(const std::filesystem::path& file) {
    std::error_code missing;
    const auto time = std::filesystem::last_write_time(file, missing);
    if (missing) return std::nullopt;
    const auto size = std::filesystem::file_size(file, missing);
    if (missing) return std::nullopt;
    return Stamp{time, size};
}

bool FileWatch::changed() {
    bool changed = written_since_;
    written_since_ = false;
    for (std::size_t i = 0; i < files_.size(); ++i) {
        const std::optional<Stamp> now = stamp(files_[i]);
        if (now == stamps_[i]) continue;
        stamps_[i] = now;
        changed = true;
    }
    return changed;
}

}  // namespace rowland::asset

#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace rowland {

/// An open file that one process at a time holds (flock), on folders that are shared by network as well. The system
/// releases it when its owner ends in any way.
class FileLock {
 public:
    /// nullopt if another process, or another lock of this one, holds it. Every caller gets it where the file system
    /// knows no locks. Creates the file, which stays. Throws Error (system) if that fails.
    static std::optional<FileLock> try_take(const std::filesystem::path& file);

    FileLock(FileLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    FileLock& operator=(FileLock&&) = delete;
    ~FileLock();

    /// For reading, and for writing at the end.
    int descriptor() const { return descriptor_; }

 private:
    explicit FileLock(int descriptor) : descriptor_(descriptor) {}
    int descriptor_;
};

}  // namespace rowland

#pragma once

#include <filesystem>
#include <optional>
#include <utility>

namespace rowland::editor {

/// That a job is being done. The system keeps it (flock), on a folder that is shared by network too, and lets go of it
/// when its owner ends, however it ends; so nothing is left to clear away.
class JobLock {
 public:
    /// Nothing if another process, or another lock of this one, has it. Where the file system knows no locks it is
    /// granted to everybody: then a job may be done twice, which costs time alone. Creates the file, which stays.
    /// Throws Error (system) if that fails.
    static std::optional<JobLock> try_take(const std::filesystem::path& file);

    JobLock(JobLock&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    JobLock& operator=(JobLock&&) = delete;
    ~JobLock();

 private:
    explicit JobLock(int fd) : fd_(fd) {}
    int fd_;
};

}  // namespace rowland::editor

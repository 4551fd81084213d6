#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

// What file.cpp asks of the operating system: system_file_posix.cpp, system_file_windows.cpp. A function with an
// error_code sets it if it fails, and leaves it alone otherwise.
namespace rowland {

/// A system's open file.
class OpenFile {
 public:
    /// Does not wait for a writer if `path` is a pipe.
    static OpenFile for_reading(const std::filesystem::path& path, std::error_code& failure);
    /// Creates the file if it is missing. Everything is written at its end.
    static OpenFile for_appending(const std::filesystem::path& path, std::error_code& failure);

    explicit OpenFile(std::intptr_t handle) : handle_(handle) {}
    OpenFile(OpenFile&& other) noexcept : handle_(std::exchange(other.handle_, kNone)) {}
    OpenFile& operator=(OpenFile&&) = delete;
    ~OpenFile();

    std::intptr_t handle() const { return handle_; }
    bool is_open() const { return handle_ != kNone; }

    /// Size in bytes; nullopt for what is not a regular file.
    std::optional<std::uint64_t> regular_size(std::error_code& failure) const;
    /// Fills `buffer`, or as much of it as the file still holds; returns the number of bytes read.
    std::size_t read(std::span<std::byte> buffer, std::error_code& failure) const;
    void write(std::span<const std::byte> data, std::error_code& failure) const;
    void cut(std::uint64_t size, std::error_code& failure) const;
    /// False if another OpenFile, of whatever process, has locked the file. True on a file system without locks. The
    /// lock does not keep others from reading the file, and ends with this object and with the process.
    bool try_lock() const;

 private:
    static constexpr std::intptr_t kNone = -1;  ///< of both systems
    std::intptr_t handle_;
};

/// A new file that replaces `target` once it is complete; if it is destroyed before, the old file stays and the new one
/// is removed, also if the program is killed where the system can do that. `target` must outlive it.
class Replacement {
 public:
    explicit Replacement(const std::filesystem::path& target);
    ~Replacement();
    Replacement(const Replacement&) = delete;
    Replacement& operator=(const Replacement&) = delete;

    void write(std::span<const std::byte> data) const;
    /// Returns when the content is on the disk and has the target's name.
    void replace_target();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Throws Error (input) unless `path` can be a regular file: renaming a file over a device or a pipe would replace it.
void require_no_device(const std::filesystem::path& path);

/// The same text for two paths that lead to one existing file, by whatever links; nullopt if there is none.
std::optional<std::string> file_identity(const std::filesystem::path& path);

/// The folder of a file; "." where the path names none.
std::filesystem::path folder_of(const std::filesystem::path& file);
/// A new name for a file beside `target`, which nobody else is likely to take.
std::filesystem::path temporary_name(const std::filesystem::path& target);
/// How often a name that somebody has taken is replaced by another before creating the file fails.
constexpr int kMostTemporaryNames = 100;

/// Throws Error (system): "path: ACTION failed: REASON".
[[noreturn]] void fail_action(const std::filesystem::path& path, const char* action, const std::error_code& reason);

}  // namespace rowland

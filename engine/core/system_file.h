#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>
#include <utility>

// What file.cpp asks of the operating system: system_file_posix.cpp, system_file_windows.cpp.
namespace rowland {

/// A system's open file. Whatever fails throws Error (system) with the file's path, unless a function says otherwise.
class OpenFile {
 public:
    /// Does not wait for a writer if `path` is a pipe. Throws Error (input).
    static OpenFile for_reading(const std::filesystem::path& path);
    /// Creates the file if it is missing. Everything is written at its end.
    static OpenFile for_appending(const std::filesystem::path& path);

    /// `path` is what errors name. The handle is closed with this object.
    OpenFile(std::filesystem::path path, std::intptr_t handle) : path_(std::move(path)), handle_(handle) {}
    OpenFile(OpenFile&& other) noexcept : path_(std::move(other.path_)), handle_(std::exchange(other.handle_, kNone)) {}
    OpenFile& operator=(OpenFile&&) = delete;
    ~OpenFile();

    std::intptr_t handle() const { return handle_; }
    bool is_open() const { return handle_ != kNone; }

    /// Size in bytes; nullopt for what is not a regular file.
    std::optional<std::uint64_t> regular_size() const;
    /// Fills `buffer`, or as much of it as the file still holds; returns the number of bytes read.
    std::size_t read(std::span<std::byte> buffer) const;
    void write(std::span<const std::byte> data) const;
    void cut(std::uint64_t size) const;
    /// False if another OpenFile, of whatever process, has locked the file. True on a file system without locks. The
    /// lock does not keep others from reading the file, and ends with this object and with the process.
    bool try_lock() const;

 private:
    static constexpr std::intptr_t kNone = -1;  ///< of both systems
    std::filesystem::path path_;
    std::intptr_t handle_;
};

/// A new file that replaces `target` once it is complete; if it is destroyed before, the old file stays and the new one
/// is removed, also if the program is killed where the system can do that.
class Replacement {
 public:
    explicit Replacement(const std::filesystem::path& target);
    ~Replacement();
    Replacement(const Replacement&) = delete;
    Replacement& operator=(const Replacement&) = delete;

    void write(std::span<const std::byte> data) const { file_.write(data); }
    /// Returns when the content is on the disk and has the target's name.
    void replace_target();

 private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;  ///< path of the new file while it has a name of its own
    OpenFile file_;                    ///< its errors name the target
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

/// Throws Error (input): "path: cannot be opened: REASON".
[[noreturn]] void refuse_unreadable(const std::filesystem::path& path, const std::error_code& reason);
/// Throws Error (system): "path: ACTION failed: REASON".
[[noreturn]] void fail_action(const std::filesystem::path& path, const char* action, const std::error_code& reason);

}  // namespace rowland

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

struct XXH3_state_s;  // of xxhash.h

namespace rowland {

/// 128-bit content hash (XXH3).
struct Hash128 {
    std::uint64_t low = 0;
    std::uint64_t high = 0;

    friend bool operator==(const Hash128&, const Hash128&) = default;
    std::string hex() const;  ///< 32 lower-case digits
};

/// Incremental content hash. Strings are hashed with their length, so ("ab","c") differs from ("a","bc").
class Hasher {
 public:
    Hasher();

    Hasher& bytes(std::span<const std::byte> data);
    Hasher& text(std::string_view data);
    Hash128 digest() const;

 private:
    std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> state_;
};

/// A reader's limit in bytes: the environment variable `name`, which is in MiB, or `least` MiB if it is not set. Throws
/// Error (input) unless the variable is a whole number from `least` to `most`.
std::uint64_t memory_limit(const char* name, std::uint64_t least, std::uint64_t most);

/// Reads a whole file. Throws Error (input) if it is missing, not a regular file, may not be read or is larger than
/// `max_bytes` (`remedy` says what to do then), and Error (system) if reading fails.
std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes,
                                 const std::string& remedy = "");
std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes);

/// The first `size` bytes of a file, or all of a shorter one. Throws as read_file() does, and for an empty file.
std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::size_t size);

/// The largest file that is hashed, so that a sparse file of terabytes does not occupy a program for hours.
inline constexpr std::uint64_t kMaximumHashedBytes = std::uint64_t{1} << 30;
/// Content hash of a file; nullopt if it is no regular file, unreadable or larger than kMaximumHashedBytes.
std::optional<Hash128> hash_file(const std::filesystem::path& path);

/// Creates a folder and its missing parents. Throws Error (system).
void create_folder(const std::filesystem::path& path);

/// Replaces the file `path`: readers see the old file or the complete new one, even if the program is killed. Creates
/// the folder. Throws Error (input) if `path` is a folder, a device or a pipe, or too long, and Error (system), leaving
/// the old file, if anything else fails.
void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> data);
void write_file_atomic(const std::filesystem::path& path, std::string_view text);
/// The same with content that lies in parts.
void write_file_atomic(const std::filesystem::path& path, std::span<const std::span<const std::byte>> parts);

class OpenFile;

/// An open file with a lock that only one FileLock holds at a time, across processes and network folders. The system
/// releases it when the process ends in any way. Others can read the file meanwhile.
class FileLock {
 public:
    /// The lock, or nullopt if another process or another FileLock of this process holds it. On a file system without
    /// locks every caller gets one. Creates the file if it is missing, and leaves it there. Throws Error (system) if it
    /// cannot be opened.
    static std::optional<FileLock> try_take(const std::filesystem::path& file);

    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&&) = delete;
    ~FileLock();

    /// Writes at the end of the file. Throws Error (system); then a part may be written.
    void append(std::string_view text);
    /// Shortens the file to its first `size` bytes. Throws Error (system).
    void cut(std::uint64_t size);

 private:
    explicit FileLock(std::unique_ptr<OpenFile> file);
    std::unique_ptr<OpenFile> file_;
};

/// A file that a program is to write.
struct Output {
    std::string option;  ///< the option that names it, as "--capture"
    std::filesystem::path path;
    std::string extension = {};  ///< of its format, as ".png", in either case; empty: any
};

/// To be called before work begins. Throws Error (input) for an output that
/// - has another extension than its format,
/// - is one of the inputs or another output, whatever name or link leads to it,
/// - cannot be written: it is a folder or a device, or its folder takes no files and cannot be created.
/// Leaves nothing on the disk. Folders that are missing are created later, by write_file_atomic().
void check_outputs(std::span<const std::filesystem::path> inputs, std::span<const Output> outputs);

}  // namespace rowland

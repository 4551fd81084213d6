#include "engine/core/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <new>
#include <random>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/text.h"

namespace rowland {

std::string Hash128::hex() const {
    return fmt::format("{:016x}{:016x}", high, low);
}

Hasher::Hasher() : state_(XXH3_createState(), [](XXH3_state_s* state) { XXH3_freeState(state); }) {
    if (state_ == nullptr) throw std::bad_alloc();
    XXH3_128bits_reset(state_.get());
}

Hasher& Hasher::bytes(std::span<const std::byte> data) {
    XXH3_128bits_update(state_.get(), data.data(), data.size());
    return *this;
}

Hasher& Hasher::text(std::string_view data) {
    const std::uint64_t size = data.size();
    XXH3_128bits_update(state_.get(), &size, sizeof size);
    XXH3_128bits_update(state_.get(), data.data(), data.size());
    return *this;
}

Hash128 Hasher::digest() const {
    const XXH128_hash_t value = XXH3_128bits_digest(state_.get());
    return {value.low64, value.high64};
}

namespace {

[[noreturn]] void fail_action(const std::filesystem::path& path, const char* action, int error_number) {
    fail_system(path.string(), fmt::format("{} failed: {}", action, std::strerror(error_number)),
                "check permissions and free space");
}

/// Throws Error (input) unless `path` can be a regular file: renaming a file over a device or a pipe would replace it.
void require_no_device(const std::filesystem::path& path) {
    if (!path.has_filename()) refuse_input(path.string(), "", "names a folder", "a file to write");
    struct stat old = {};
    if (::stat(path.c_str(), &old) == 0) {
        if (!S_ISREG(old.st_mode))
            refuse_input(path.string(), "", "exists and is not a regular file", "a file to write");
        return;
    }
    // stat() stops at the first missing folder, so the names below it are checked one by one.
    int code = errno;
    for (const std::filesystem::path& name : path)
        if (code == ENOENT && ::lstat(name.c_str(), &old) != 0 && errno == ENAMETOOLONG) code = errno;
    if (code == ELOOP || code == ENAMETOOLONG) refuse_input(path.string(), "", std::strerror(code), "a file to write");
}

/// An open file descriptor.
class Descriptor {
 public:
    explicit Descriptor(int fd) : fd_(fd) {}
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    int get() const { return fd_; }

 private:
    int fd_;
};

/// A regular file that is open for reading.
class SourceFile {
 public:
    /// Throws Error (input) for what is no readable file, and for a file larger than `max_bytes`.
    SourceFile(const std::filesystem::path& path, std::uint64_t max_bytes, const std::string& remedy = "")
        // Non-blocking: opening a pipe must not wait for a writer. It changes nothing for regular files.
        : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
        if (file_.get() < 0)
            refuse_input(path.string(), "", fmt::format("cannot be opened: {}", std::strerror(errno)),
                         "a readable file");
        struct stat status = {};
        if (::fstat(file_.get(), &status) != 0) fail_action(path, "stat", errno);
        if (!S_ISREG(status.st_mode)) refuse_input(path.string(), "", "not a regular file", "a readable file");
        size_ = static_cast<std::uint64_t>(status.st_size);
        if (size_ > max_bytes)
            refuse_input(path.string(), "", fmt::format("{} bytes", size_), fmt::format("at most {} bytes", max_bytes),
                         remedy);
    }

    std::size_t size() const { return static_cast<std::size_t>(size_); }

    /// Fills `buffer`, or as much of it as the file still holds; returns the number of bytes read.
    std::size_t read(std::span<std::byte> buffer) {
        std::size_t done = 0;
        while (done < buffer.size()) {
            const ssize_t count = ::read(file_.get(), buffer.data() + done, buffer.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail_action(path_, "reading", errno);
            if (count == 0) break;
            done += static_cast<std::size_t>(count);
        }
        return done;
    }

 private:
    const std::filesystem::path& path_;
    Descriptor file_;
    std::uint64_t size_ = 0;
};

template <typename Buffer>
Buffer read_whole(const std::filesystem::path& path, std::uint64_t max_bytes, const std::string& remedy = "") {
    SourceFile file(path, max_bytes, remedy);
    Buffer data(file.size(), {});
    data.resize(file.read(std::as_writable_bytes(std::span(data))));  // the file may be truncated while we read
    return data;
}

/// False, with errno set, if not everything could be written.
bool write_all(int fd, std::span<const std::byte> data) {
    while (!data.empty()) {
        const ssize_t count = ::write(fd, data.data(), data.size());
        if (count >= 0)
            data = data.subspan(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            return false;
    }
    return true;
}

/// A new file that replaces `target` once it is complete; if it is destroyed before, the old file stays and the new one
/// is removed. Where the file system supports O_TMPFILE the file has no name while it is written, so that a killed
/// program leaves nothing. Its permissions follow the user's umask. (mkstemp's files are private, and the umask cannot
/// be read without setting it for all threads.)
class Replacement {
 public:
    explicit Replacement(const std::filesystem::path& target)
        : target_(target),
          folder_(target.has_parent_path() ? target.parent_path() : std::filesystem::path(".")),
          file_(create()) {}
    ~Replacement() {
        if (!temporary_.empty()) ::unlink(temporary_.c_str());
    }
    Replacement(const Replacement&) = delete;
    Replacement& operator=(const Replacement&) = delete;

    void write(std::span<const std::byte> data) const {
        if (!write_all(file_.get(), data)) fail_action(target_, "writing", errno);
    }

    void replace_target() {
        if (::fsync(file_.get()) != 0) fail_action(target_, "writing", errno);
        if (temporary_.empty()) {
            const std::string nameless = fmt::format("/proc/self/fd/{}", file_.get());
            take_new_name([&](const char* name) {
                return ::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW);
            });
        }
        if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail_action(target_, "renaming", errno);
        temporary_.clear();
    }

 private:
    int create() {
        // A nameless file gets its name through /proc.
        const bool can_be_named = ::access("/proc/self/fd", X_OK) == 0;
        const int fd = can_be_named ? ::open(folder_.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666) : -1;
        if (fd >= 0) return fd;
        return take_new_name(
            [](const char* name) { return ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
    }

    /// `make(name)` creates the file; it returns a negative number, with errno EEXIST, if the name is taken.
    template <typename Make>
    int take_new_name(const Make& make) {
        std::random_device random;
        for (int attempt = 0;; ++attempt) {
            const std::filesystem::path name = folder_ / fmt::format(".rowland-{:08x}{:08x}", random(), random());
            const int result = make(name.c_str());
            if (result >= 0) {
                temporary_ = name;
                return result;
            }
            if (errno != EEXIST || attempt == 100) fail_action(target_, "creating a temporary file beside it", errno);
        }
    }

    const std::filesystem::path& target_;
    std::filesystem::path folder_;
    std::filesystem::path temporary_;  ///< path of the new file while it has a name
    Descriptor file_;
};

}  // namespace

std::uint64_t memory_limit(const char* name, std::uint64_t least, std::uint64_t most) {
    const char* value = std::getenv(name);
    std::uint64_t mebibytes = least;
    if (value != nullptr) {
        const char* const end = value + std::strlen(value);
        const auto [read, code] = std::from_chars(value, end, mebibytes);
        if (code != std::errc() || read != end || mebibytes < least || mebibytes > most)
            refuse_input(name, "", fmt::format("\"{:.40}\"", value),
                         fmt::format("a number of MiB from {} to {}", least, most));
    }
    return mebibytes << 20;
}

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes,
                                 const std::string& remedy) {
    return read_whole<std::vector<std::byte>>(path, max_bytes, remedy);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::string>(path, max_bytes);
}

std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::size_t size) {
    std::vector<std::byte> buffer(size);
    buffer.resize(SourceFile(path, std::numeric_limits<std::uint64_t>::max()).read(buffer));
    if (buffer.empty()) refuse_input(path.string(), "", "an empty file", "a readable file");
    return buffer;
}

std::optional<Hash128> hash_file(const std::filesystem::path& path) {
    try {
        SourceFile file(path, kMaximumHashedBytes);
        Hasher hasher;
        std::vector<std::byte> buffer(1 << 20);
        std::uint64_t total = 0;
        while (const std::size_t count = file.read(buffer)) {
            hasher.bytes(std::span(buffer).first(count));
            total += count;
            if (total > kMaximumHashedBytes) return std::nullopt;  // it grows while we read
        }
        return hasher.digest();
    } catch (const Error&) {
        return std::nullopt;
    }
}

void create_folder(const std::filesystem::path& path) {
    std::error_code code;
    std::filesystem::create_directories(path, code);
    if (code) fail_action(path, "creating the folder", code.value());
}

void write_file_atomic(const std::filesystem::path& path, std::span<const std::span<const std::byte>> parts) {
    require_no_device(path);
    if (path.has_parent_path()) create_folder(path.parent_path());
    Replacement replacement(path);
    for (const std::span<const std::byte> part : parts) replacement.write(part);
    replacement.replace_target();
}

void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> data) {
    write_file_atomic(path, std::span(&data, 1));
}

void write_file_atomic(const std::filesystem::path& path, std::string_view text) {
    write_file_atomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

std::optional<FileLock> FileLock::try_take(const std::filesystem::path& file) {
    FileLock lock(::open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (lock.descriptor_ < 0) fail_action(file, "opening", errno);
    while (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return std::nullopt;
        if (errno != EINTR) break;
    }
    return lock;
}

FileLock::~FileLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

namespace {

/// Two paths lead to one file exactly if they have a key in common: the path without links, or the inode.
std::vector<std::string> keys_of(const std::filesystem::path& path) {
    std::error_code code;
    const std::filesystem::path canonical =
        std::filesystem::weakly_canonical(std::filesystem::absolute(path, code), code);
    std::vector<std::string> keys{code ? path.string() : canonical.string()};
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0) keys.push_back(fmt::format("{}:{}", status.st_dev, status.st_ino));
    return keys;
}

/// Throws the Error with which write_file_atomic(path, ...) would fail before writing. It tries with a file in the
/// nearest folder that exists, and removes it.
void require_writable(const std::filesystem::path& path) {
    require_no_device(path);
    std::error_code ignored;
    std::filesystem::path folder = std::filesystem::absolute(path, ignored).parent_path();
    while (!std::filesystem::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
    const Replacement attempt(folder / "file");
}

}  // namespace

void check_outputs(std::span<const std::filesystem::path> inputs, std::span<const Output> outputs) {
    std::map<std::string, std::string> users;  // what uses the file with each key
    for (const std::filesystem::path& input : inputs)
        for (const std::string& key : keys_of(input)) users.emplace(key, "an input");
    for (const auto& [option, path, extension] : outputs) {
        const std::string file = fmt::format("{} {}", option, path.string());
        if (!extension.empty() && lower_case(path.extension().string()) != lower_case(extension))
            refuse_input(file, {}, fmt::format("the extension \"{}\"", path.extension().string()), extension,
                         "name the file by its format");
        const std::vector<std::string> keys = keys_of(path);
        for (const std::string& key : keys)
            if (const auto user = users.find(key); user != users.end())
                refuse_input(file, {}, "the same file as " + user->second, "a file of its own", "name another file");
        for (const std::string& key : keys) users.emplace(key, "the output of " + option);
        try {
            require_writable(path);
        } catch (const Error& error) {
            refuse_input(file, {}, error.info().found, "a file that can be written", "name another file");
        }
    }
}

}  // namespace rowland

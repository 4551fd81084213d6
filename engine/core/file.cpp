#include "engine/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <random>
#include <system_error>

#include <fmt/format.h>

#include "engine/core/error.h"

namespace rowland {

namespace {

[[noreturn]] void fail_action(const std::filesystem::path& path, const char* action, int error_number) {
    fail_system(path.string(), fmt::format("{} failed: {}", action, std::strerror(error_number)),
                "check permissions and free space");
}

/// Renaming over a device or a pipe would replace it by a file.
void require_no_device(const std::filesystem::path& path) {
    if (!path.has_filename()) refuse_input(path.string(), "", "names a folder", "a file to write");
    struct stat old = {};
    if (::stat(path.c_str(), &old) == 0 && !S_ISREG(old.st_mode))
        refuse_input(path.string(), "", "exists and is not a regular file", "a file to write");
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

template <typename Buffer>
Buffer read_whole(const std::filesystem::path& path, std::uint64_t max_bytes) {
    // Non-blocking: opening a pipe must not wait for a writer. It changes nothing for regular files.
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file.get() < 0)
        refuse_input(path.string(), "", fmt::format("cannot be opened: {}", std::strerror(errno)), "a readable file");
    struct stat status = {};
    if (::fstat(file.get(), &status) != 0) fail_action(path, "stat", errno);
    if (!S_ISREG(status.st_mode)) refuse_input(path.string(), "", "not a regular file", "a readable file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > max_bytes)
        refuse_input(path.string(), "", fmt::format("{} bytes", size), fmt::format("at most {} bytes", max_bytes));
    Buffer data(static_cast<std::size_t>(size), {});
    std::size_t done = 0;
    while (done < data.size()) {
        const ssize_t count = ::read(file.get(), data.data() + done, data.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_action(path, "reading", errno);
        if (count == 0) break;  // the file was truncated while we read
        done += static_cast<std::size_t>(count);
    }
    data.resize(done);
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

    /// `make(name)` creates the file; negative, with errno EEXIST, if the name is taken.
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
    std::filesystem::path temporary_;  ///< its name, while it has one
    Descriptor file_;
};

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::vector<std::byte>>(path, max_bytes);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::string>(path, max_bytes);
}

void create_folder(const std::filesystem::path& path) {
    std::error_code code;
    std::filesystem::create_directories(path, code);
    if (code) fail_action(path, "creating the folder", code.value());
}

void require_writable(const std::filesystem::path& path) {
    require_no_device(path);
    std::filesystem::path folder = std::filesystem::absolute(path).parent_path();
    std::error_code ignored;
    while (!std::filesystem::exists(folder, ignored) && folder.has_relative_path()) folder = folder.parent_path();
    const Replacement attempt(folder / "file");
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

}  // namespace rowland

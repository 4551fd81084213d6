#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>

#include "engine/core/error.h"
#include "engine/core/system_file.h"

namespace rowland {

namespace {

std::error_code last_failure() {
    return {errno, std::generic_category()};
}

int descriptor_of(const OpenFile& file) {
    return static_cast<int>(file.handle());
}

}  // namespace

OpenFile OpenFile::for_reading(const std::filesystem::path& path) {
    // Non-blocking: opening a pipe must not wait for a writer. It changes nothing for regular files.
    OpenFile file(path, ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (!file.is_open()) refuse_unreadable(path, last_failure());
    return file;
}

OpenFile OpenFile::for_appending(const std::filesystem::path& path) {
    OpenFile file(path, ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!file.is_open()) fail_action(path, "opening", last_failure());
    return file;
}

OpenFile::~OpenFile() {
    if (is_open()) ::close(descriptor_of(*this));
}

std::optional<std::uint64_t> OpenFile::regular_size() const {
    struct stat status = {};
    if (::fstat(descriptor_of(*this), &status) != 0) fail_action(path_, "stat", last_failure());
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return static_cast<std::uint64_t>(status.st_size);
}

std::size_t OpenFile::read(std::span<std::byte> buffer) const {
    std::size_t done = 0;
    while (done < buffer.size()) {
        const ssize_t count = ::read(descriptor_of(*this), buffer.data() + done, buffer.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_action(path_, "reading", last_failure());
        if (count == 0) break;
        done += static_cast<std::size_t>(count);
    }
    return done;
}

void OpenFile::write(std::span<const std::byte> data) const {
    while (!data.empty()) {
        const ssize_t count = ::write(descriptor_of(*this), data.data(), data.size());
        if (count >= 0)
            data = data.subspan(static_cast<std::size_t>(count));
        else if (errno != EINTR)
            fail_action(path_, "writing", last_failure());
    }
}

void OpenFile::cut(std::uint64_t size) const {
    if (::ftruncate(descriptor_of(*this), static_cast<off_t>(size)) != 0)
        fail_action(path_, "shortening", last_failure());
}

bool OpenFile::try_lock() const {
    while (::flock(descriptor_of(*this), LOCK_EX | LOCK_NB) != 0) {
        if (errno == EWOULDBLOCK) return false;
        if (errno != EINTR) break;
    }
    return true;
}

namespace {

/// `make(name)` creates a file of that name beside `target`; it returns a negative number, with errno EEXIST, if the
/// name is taken. Returns what it returned, and the name in `temporary`.
template <typename Make>
int take_new_name(const std::filesystem::path& target, std::filesystem::path& temporary, const Make& make) {
    for (int attempt = 0;; ++attempt) {
        const std::filesystem::path name = temporary_name(target);
        const int result = make(name.c_str());
        if (result >= 0) {
            temporary = name;
            return result;
        }
        if (errno != EEXIST || attempt == kMostTemporaryNames)
            fail_action(target, "creating a temporary file beside it", last_failure());
    }
}

/// Where the file system supports O_TMPFILE the file has no name while it is written, so that a killed program leaves
/// nothing. Its permissions follow the user's umask. (mkstemp's files are private, and the umask cannot be read without
/// setting it for all threads.)
int create(const std::filesystem::path& target, std::filesystem::path& temporary) {
    // A nameless file gets its name through /proc.
    const bool can_be_named = ::access("/proc/self/fd", X_OK) == 0;
    const int fd = can_be_named ? ::open(folder_of(target).c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0666) : -1;
    if (fd >= 0) return fd;
    return take_new_name(target, temporary,
                         [](const char* name) { return ::open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); });
}

}  // namespace

Replacement::Replacement(const std::filesystem::path& target)
    : target_(target), file_(target, create(target, temporary_)) {}

Replacement::~Replacement() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void Replacement::replace_target() {
    const int fd = descriptor_of(file_);
    if (::fsync(fd) != 0) fail_action(target_, "writing", last_failure());
    if (temporary_.empty()) {
        const std::string nameless = fmt::format("/proc/self/fd/{}", fd);
        take_new_name(target_, temporary_, [&](const char* name) {
            return ::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name, AT_SYMLINK_FOLLOW);
        });
    }
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail_action(target_, "renaming", last_failure());
    temporary_.clear();
}

void require_no_device(const std::filesystem::path& path) {
    if (!path.has_filename()) refuse_input(path.string(), "", "names a folder", "a file to write");
    struct stat old = {};
    if (::stat(path.c_str(), &old) == 0) {
        if (!S_ISREG(old.st_mode))
            refuse_input(path.string(), "", "exists and is not a regular file", "a file to write");
        return;
    }
    // stat() stops at the first missing folder, so the names below it are checked one by one.
    std::error_code reason = last_failure();
    for (const std::filesystem::path& name : path)
        if (reason.value() == ENOENT && ::lstat(name.c_str(), &old) != 0 && errno == ENAMETOOLONG)
            reason = last_failure();
    if (reason.value() == ELOOP || reason.value() == ENAMETOOLONG)
        refuse_input(path.string(), "", reason.message(), "a file to write");
}

std::optional<std::string> file_identity(const std::filesystem::path& path) {
    struct stat status = {};
    if (::stat(path.c_str(), &status) != 0) return std::nullopt;
    return fmt::format("{}:{}", status.st_dev, status.st_ino);
}

}  // namespace rowland

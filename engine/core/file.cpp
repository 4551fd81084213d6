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

[[noreturn]] void fail_system(const std::filesystem::path& path, const char* action, int error_number) {
    throw Error({.file = path.string(),
                 .place = {},
                 .found = fmt::format("{} failed: {}", action, std::strerror(error_number)),
                 .expected = {},
                 .remedy = "check permissions and free space",
                 .fault = Fault::System});
}

[[noreturn]] void fail_input(const std::filesystem::path& path, std::string found, std::string expected) {
    throw Error(
        {.file = path.string(), .place = {}, .found = std::move(found), .expected = std::move(expected), .remedy = {}});
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
    if (file.get() < 0) fail_input(path, fmt::format("cannot be opened: {}", std::strerror(errno)), "a readable file");
    struct stat status = {};
    if (::fstat(file.get(), &status) != 0) fail_system(path, "stat", errno);
    if (!S_ISREG(status.st_mode)) fail_input(path, "not a regular file", "a readable file");
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > max_bytes) fail_input(path, fmt::format("{} bytes", size), fmt::format("at most {} bytes", max_bytes));
    Buffer data(static_cast<std::size_t>(size), {});
    std::size_t done = 0;
    while (done < data.size()) {
        const ssize_t count = ::read(file.get(), data.data() + done, data.size() - done);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail_system(path, "reading", errno);
        if (count == 0) break;  // the file was cut while we read
        done += static_cast<std::size_t>(count);
    }
    data.resize(done);
    return data;
}

/// Creates a file of a new name in `folder`, with the permissions the user's mask grants any new file. (mkstemp's files
/// are private, and the mask cannot be read without setting it for all threads.)
int create_beside(const std::filesystem::path& path, const std::filesystem::path& folder,
                  std::filesystem::path& temporary) {
    std::random_device random;
    for (int attempt = 0;; ++attempt) {
        temporary = folder / fmt::format(".rowland-{:08x}{:08x}", random(), random());
        const int fd = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd >= 0) return fd;
        if (errno != EEXIST || attempt == 100) fail_system(path, "creating a temporary file beside it", errno);
    }
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

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::vector<std::byte>>(path, max_bytes);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::string>(path, max_bytes);
}

void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> data) {
    // Renaming over a device or a pipe would replace it by a file.
    struct stat old = {};
    if (::stat(path.c_str(), &old) == 0 && !S_ISREG(old.st_mode))
        fail_input(path, "exists and is not a regular file", "a file to write");

    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) fail_system(folder, "creating the folder", code.value());

    std::filesystem::path temporary;
    int error_number = 0;
    const char* action = nullptr;
    {
        const Descriptor file(create_beside(path, folder, temporary));
        if (!write_all(file.get(), data) || ::fsync(file.get()) != 0) {
            error_number = errno;
            action = "writing";
        }
    }
    if (action == nullptr && std::rename(temporary.c_str(), path.c_str()) != 0) {
        error_number = errno;
        action = "renaming";
    }
    if (action != nullptr) {
        ::unlink(temporary.c_str());
        fail_system(path, action, error_number);
    }
}

void write_file_atomic(const std::filesystem::path& path, std::string_view text) {
    write_file_atomic(path, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace rowland

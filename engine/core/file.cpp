#include "engine/core/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
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
    throw Error({.file = path.string(),
                 .place = {},
                 .found = std::move(found),
                 .expected = std::move(expected),
                 .remedy = {}});
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
    const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
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

}  // namespace

std::vector<std::byte> read_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::vector<std::byte>>(path, max_bytes);
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
    return read_whole<std::string>(path, max_bytes);
}

void write_file_atomic(const std::filesystem::path& path, std::span<const std::byte> data) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    std::error_code code;
    std::filesystem::create_directories(folder, code);
    if (code) fail_system(folder, "creating the folder", code.value());

    std::string temporary = path.string() + ".XXXXXX";
    int error_number = 0;
    const char* action = nullptr;
    {
        const Descriptor file(::mkostemp(temporary.data(), O_CLOEXEC));
        if (file.get() < 0) fail_system(path, "creating a temporary file beside it", errno);
        std::size_t done = 0;
        while (done < data.size() && action == nullptr) {
            const ssize_t count = ::write(file.get(), data.data() + done, data.size() - done);
            if (count >= 0) {
                done += static_cast<std::size_t>(count);
            } else if (errno != EINTR) {
                error_number = errno;
                action = "writing";
            }
        }
        // mkstemp makes files private; ours are as readable as any other output.
        const mode_t mask = ::umask(0);
        ::umask(mask);
        if (action == nullptr && ::fchmod(file.get(), 0666 & ~mask) != 0) {
            error_number = errno;
            action = "setting permissions";
        }
        if (action == nullptr && ::fsync(file.get()) != 0) {
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

#include "engine/cook/source_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <span>
#include <string>

#include "engine/core/error.h"

namespace rowland::cook {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, std::string found) {
    refuse_input(path.string(), {}, std::move(found), "a readable file");
}

/// A regular file open for reading.
class SourceFile {
 public:
    explicit SourceFile(const std::filesystem::path& path)
        // Non-blocking: opening a pipe must not wait for a writer.
        : path_(path), fd_(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
        if (fd_ < 0) fail(path_, std::string("cannot be opened: ") + std::strerror(errno));
        struct stat status = {};
        const bool known = ::fstat(fd_, &status) == 0;
        if (known && S_ISREG(status.st_mode)) {
            size_ = static_cast<std::uint64_t>(status.st_size);
            return;
        }
        ::close(fd_);
        fail(path_, known ? "not a regular file" : "cannot be examined");
    }
    ~SourceFile() { ::close(fd_); }
    SourceFile(const SourceFile&) = delete;
    SourceFile& operator=(const SourceFile&) = delete;

    std::uint64_t size() const { return size_; }

    /// Fills `buffer`, or as much of it as the file holds; returns the part filled.
    std::span<const std::byte> read(std::span<std::byte> buffer) {
        std::size_t done = 0;
        while (done < buffer.size()) {
            const ssize_t count = ::read(fd_, buffer.data() + done, buffer.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) fail(path_, std::string("cannot be read: ") + std::strerror(errno));
            if (count == 0) break;
            done += static_cast<std::size_t>(count);
        }
        return buffer.first(done);
    }

 private:
    const std::filesystem::path& path_;
    int fd_;
    std::uint64_t size_ = 0;
};

}  // namespace

std::optional<Hash128> hash_file(const std::filesystem::path& path) {
    try {
        SourceFile file(path);
        if (file.size() > kMaximumSourceBytes) return std::nullopt;
        Hasher hasher;
        std::vector<std::byte> buffer(1 << 20);
        std::uint64_t total = 0;
        for (auto part = file.read(buffer); !part.empty(); part = file.read(buffer)) {
            hasher.bytes(part);
            total += part.size();
            if (total > kMaximumSourceBytes) return std::nullopt;  // it grows while we read
        }
        return hasher.digest();
    } catch (const Error&) {
        return std::nullopt;
    }
}

void fail_changed(const std::filesystem::path& path) {
    fail_system(path.string(), "changed while it was being cooked", "cook again");
}

std::vector<std::byte> read_beginning(const std::filesystem::path& path, std::size_t size) {
    SourceFile file(path);
    std::vector<std::byte> buffer(size);
    buffer.resize(file.read(buffer).size());
    if (buffer.empty()) fail(path, "an empty file");
    return buffer;
}

}  // namespace rowland::cook

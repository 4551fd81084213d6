#include "editor/cooker/job_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "engine/core/error.h"

namespace rowland::editor {

std::optional<JobLock> JobLock::try_take(const std::filesystem::path& file) {
    const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0)
        throw Error({.file = file.string(),
                     .place = {},
                     .found = std::string("creating it failed: ") + std::strerror(errno),
                     .expected = {},
                     .remedy = "check permissions and free space",
                     .fault = Fault::System});
    int refused = 0;
    do {
        refused = ::flock(fd, LOCK_EX | LOCK_NB);
    } while (refused != 0 && errno == EINTR);
    if (refused != 0 && errno == EWOULDBLOCK) {
        ::close(fd);
        return std::nullopt;
    }
    return JobLock(fd);
}

JobLock::~JobLock() {
    if (fd_ >= 0) ::close(fd_);
}

}  // namespace rowland::editor

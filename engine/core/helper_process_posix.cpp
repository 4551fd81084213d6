#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>

#include "engine/core/helper_process.h"

namespace rowland {

namespace {

/// Sets the soft limit only, since an unprivileged process could not raise the hard one again.
void limit(int resource, rlim_t most) {
    const auto kind = static_cast<__rlimit_resource>(resource);
    rlimit limits{};
    if (getrlimit(kind, &limits) != 0) std::_Exit(1);
    limits.rlim_cur = std::min(most, limits.rlim_max);
    if (setrlimit(kind, &limits) != 0) std::_Exit(1);
}

/// Calls `transfer`, which is read() or write(), until all bytes have passed.
template <typename Byte, typename Transfer>
bool exchange(Byte* data, std::size_t size, const Transfer& transfer) {
    for (std::size_t done = 0; done < size;) {
        // The socket is the standard input, and works in both directions.
        const ssize_t count = transfer(STDIN_FILENO, data + done, size - done);
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return false;
        done += static_cast<std::size_t>(count);
    }
    return true;
}

}  // namespace

void prepare_helper() {
    // The starter may be killed while this process works.
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    std::signal(SIGPIPE, SIG_IGN);
    limit(RLIMIT_CORE, 0);
}

bool receive_from_starter(void* data, std::size_t size) {
    return exchange(static_cast<std::byte*>(data), size, ::read);
}

bool send_to_starter(const void* data, std::size_t size) {
    return exchange(static_cast<const std::byte*>(data), size, ::write);
}

void limit_memory(std::uint64_t bytes) {
    limit(RLIMIT_AS, bytes);
}

}  // namespace rowland

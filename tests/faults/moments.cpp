#include "tests/faults/moments.h"

#include <sys/ptrace.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <stdexcept>
#include <system_error>

namespace rowland::test {

namespace {

/// Which argument of a system call says what file it is about: its path, or its descriptor.
struct Call {
    long number;
    const char* name;
    bool by_path;
    std::size_t argument;
};

constexpr std::array kCalls = {
    Call{SYS_openat, "openat", true, 1},       Call{SYS_newfstatat, "newfstatat", true, 1},
    Call{SYS_mkdirat, "mkdirat", true, 1},     Call{SYS_unlinkat, "unlinkat", true, 1},
    Call{SYS_linkat, "linkat", true, 3},       Call{SYS_renameat, "renameat", true, 3},
    Call{SYS_renameat2, "renameat2", true, 3}, Call{SYS_read, "read", false, 0},
    Call{SYS_write, "write", false, 0},        Call{SYS_pwrite64, "pwrite64", false, 0},
    Call{SYS_fsync, "fsync", false, 0},        Call{SYS_ftruncate, "ftruncate", false, 0},
    Call{SYS_flock, "flock", false, 0},
#ifdef SYS_open  // newer machines have none of these
    Call{SYS_open, "open", true, 0},           Call{SYS_stat, "stat", true, 0},
    Call{SYS_lstat, "lstat", true, 0},         Call{SYS_mkdir, "mkdir", true, 0},
    Call{SYS_unlink, "unlink", true, 0},       Call{SYS_link, "link", true, 1},
    Call{SYS_rename, "rename", true, 1},
#endif
};

std::string text_at(pid_t thread, std::uint64_t address) {
    std::string text(4096, '\0');
    // Up to the end of the page: the next may not be there.
    const std::size_t size = text.size() - address % text.size();
    const iovec here{text.data(), size};
    const iovec there{reinterpret_cast<void*>(address), size};  // NOLINT: an address in another program
    const ssize_t read = ::process_vm_readv(thread, &here, 1, &there, 1, 0);
    text.resize(read < 0 ? 0 : static_cast<std::size_t>(read));
    return text.substr(0, text.find('\0'));
}

std::string path_of(pid_t thread, const Call& call, std::uint64_t argument) {
    if (call.by_path) return text_at(thread, argument);
    std::error_code missing;
    const std::string link = "/proc/" + std::to_string(thread) + "/fd/" + std::to_string(static_cast<int>(argument));
    return std::filesystem::read_symlink(link, missing).string();
}

/// The system call about a file in `folder` that a stopped thread is about to make.
const Call* call_about(pid_t thread, const std::string& folder) {
    __ptrace_syscall_info info = {};
    const long size = ::ptrace(PTRACE_GET_SYSCALL_INFO, thread, sizeof info, &info);
    if (size <= 0 || info.op != PTRACE_SYSCALL_INFO_ENTRY) return nullptr;
    const auto call = std::find_if(kCalls.begin(), kCalls.end(), [&](const Call& candidate) {
        return static_cast<std::uint64_t>(candidate.number) == info.entry.nr;
    });
    if (call == kCalls.end()) return nullptr;
    return path_of(thread, *call, info.entry.args[call->argument]).starts_with(folder) ? &*call : nullptr;
}

/// The signal that a stop hands on to the program; the tracer's own stops hand on none.
int signal_of(int status) {
    const int signal = WSTOPSIG(status);
    const bool ours = signal == (SIGTRAP | 0x80) || signal == SIGTRAP || signal == SIGSTOP;
    return ours ? 0 : signal;
}

}  // namespace

Ended run_with_moments(const Command& command, const std::filesystem::path& folder, const Intervention& intervene,
                       Surroundings surroundings) {
    surroundings.traced = true;
    Running program(command, surroundings);
    int status = 0;
    if (::waitpid(program.pid(), &status, __WALL) < 0 || !WIFSTOPPED(status))
        throw std::runtime_error("cannot trace " + command.front());
    ::ptrace(PTRACE_SETOPTIONS, program.pid(), nullptr,
             PTRACE_O_TRACESYSGOOD | PTRACE_O_TRACECLONE | PTRACE_O_EXITKILL);
    ::ptrace(PTRACE_SYSCALL, program.pid(), nullptr, nullptr);
    Moment moment;
    for (;;) {
        const pid_t thread = ::waitpid(-1, &status, __WALL);
        if (thread < 0) throw std::runtime_error("lost " + command.front());
        if (!WIFSTOPPED(status)) {
            if (thread == program.pid()) return program.ended(status);
            continue;
        }
        const bool at_a_call = WSTOPSIG(status) == (SIGTRAP | 0x80);
        if (const Call* call = at_a_call ? call_about(thread, folder.string()) : nullptr; call != nullptr) {
            moment.call = call->name;
            if (!intervene(moment)) program.kill();
            ++moment.number;
        }
        // Of a thread that was just killed this fails, as it may.
        ::ptrace(PTRACE_SYSCALL, thread, nullptr, signal_of(status));
    }
}

}  // namespace rowland::test

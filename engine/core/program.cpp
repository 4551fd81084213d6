#include "engine/core/program.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <limits>
#include <new>
#include <system_error>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/log.h"

namespace rowland {

int run_program(const std::function<int()>& body) {
    try {
        const int code = body();
        // A full disk or a closed pipe is noticed only when the buffer is written.
        if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
            fail_system("standard output", fmt::format("writing failed: {}", std::strerror(errno)));
        return code;
    } catch (const Error& error) {
        log_error("{}", error.what());
        return error.info().fault == Fault::Input ? 2 : 1;
    } catch (const std::bad_alloc&) {
        log_error("out of memory");
        return 1;
    } catch (const std::exception& error) {
        log_error("{}", error.what());
        return 1;
    }
}

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& program, const std::string& what, int code) {
    fail_system(program.string(), fmt::format("{}: {}", what, std::strerror(code)),
                "install Rowland again, or free processes and files");
}

/// Starts the program by posix_spawn: fork would copy page tables and the locks that the drivers' threads hold.
pid_t spawn(const fs::path& program, int standard_input) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, standard_input, STDIN_FILENO);
    for (const int output : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
    std::string name = program.string();
    std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t process = -1;
    const int code = posix_spawn(&process, name.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code != 0) fail(program, "cannot be started", code);
    return process;
}

}  // namespace

[[gnu::weak]] const char* installed_helper_folder() {
    return ROWLAND_INSTALLED_HELPER_FOLDER;
}

namespace {

std::vector<fs::path> helper_folders() {
    if (const char* named = std::getenv("ROWLAND_HELPER_FOLDER")) return {named};
    std::vector<fs::path> folders;
    std::error_code unknown;
    const fs::path running = fs::read_symlink("/proc/self/exe", unknown);
    Dl_info library{};
    if (dladdr(reinterpret_cast<const void*>(&helper_program), &library) == 0) library.dli_fname = "";
    for (const fs::path& file : {running, fs::path(library.dli_fname)}) {
        const fs::path folder = file.parent_path();
        // For code in the program itself dladdr() gives argv[0]: a path that may be relative, or into the same folder.
        if (!folder.is_absolute() || (!folders.empty() && folder == folders.front())) continue;
        folders.push_back(folder);
        folders.push_back((folder / ROWLAND_HELPER_FOLDER_FROM_BIN).lexically_normal());
    }
    folders.emplace_back(installed_helper_folder());
    return folders;
}

}  // namespace

ChildProcess::ChildProcess(const fs::path& program) {
    std::array<int, 2> ends{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) fail(program, "no socket", errno);
    try {
        process_ = spawn(program, ends[1]);
    } catch (...) {
        close(ends[0]);
        close(ends[1]);
        throw;
    }
    close(ends[1]);
    socket_ = ends[0];
}

ChildProcess::~ChildProcess() {
    close(socket_);
    if (process_ == -1) return;
    kill(process_, SIGKILL);
    reap();
}

/// Calls `transfer` until all bytes are sent or received.
template <typename Byte, typename Transfer>
ChildProcess::Exchange ChildProcess::exchange(std::span<Byte> bytes, short event, Deadline deadline,
                                              const Transfer& transfer) {
    while (!bytes.empty()) {
        const ssize_t count = transfer(bytes.data(), bytes.size());
        if (count > 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(count));
        } else if (count < 0 && errno == EAGAIN) {
            if (const Exchange waited = wait(event, deadline); waited != Exchange::Done) return waited;
        } else if (count == 0 || errno != EINTR) {
            return Exchange::Ended;
        }
    }
    return Exchange::Done;
}

ChildProcess::Exchange ChildProcess::send(std::span<const std::byte> bytes, Deadline deadline) {
    return exchange(bytes, POLLOUT, deadline, [&](const std::byte* data, std::size_t size) {
        return ::send(socket_, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    });
}

ChildProcess::Exchange ChildProcess::receive(std::span<std::byte> bytes, Deadline deadline) {
    return exchange(bytes, POLLIN, deadline,
                    [&](std::byte* data, std::size_t size) { return recv(socket_, data, size, MSG_DONTWAIT); });
}

/// Waits for `event` or the end of the program, which the next exchange reports.
ChildProcess::Exchange ChildProcess::wait(short event, Deadline deadline) const {
    while (true) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
        if (left.count() <= 0) return Exchange::Late;
        pollfd watched{socket_, event, 0};
        const auto timeout = std::min<std::int64_t>(left.count(), std::numeric_limits<int>::max());
        const int ready = poll(&watched, 1, static_cast<int>(timeout));
        if (ready > 0) return Exchange::Done;
        if (ready < 0 && errno != EINTR) return Exchange::Ended;
    }
}

int ChildProcess::reap() {
    int status = 0;
    while (waitpid(process_, &status, 0) == -1 && errno == EINTR) {
    }
    process_ = -1;
    return status;
}

std::string ChildProcess::ending() {
    if (process_ == -1) return "ended";
    kill(process_, SIGKILL);  // reap() must not wait; a process that is ending keeps its own status
    const int status = reap();
    if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
    return fmt::format("ended with code {}", WEXITSTATUS(status));
}

fs::path helper_program(const std::string& name) {
    std::string looked_at;
    for (const fs::path& folder : helper_folders()) {
        if (fs::path program = folder / name; access(program.c_str(), X_OK) == 0) return program;
        looked_at += (looked_at.empty() ? "" : ", ") + folder.string();
    }
    fail_system(name, "not in " + looked_at, "install Rowland again, or name its folder in ROWLAND_HELPER_FOLDER",
                "a helper program of Rowland");
}

std::string version_text(const std::string& program) {
    std::string commit;
    for (const fs::path& folder : helper_folders())
        if (std::ifstream file(folder / "commit"); commit.empty()) std::getline(file, commit);
    return fmt::format("{} {}, commit {}, {}", program, ROWLAND_VERSION, commit.empty() ? "unknown" : commit,
                       ROWLAND_COMPILER);
}

}  // namespace rowland

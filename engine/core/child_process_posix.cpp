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
#include <cstring>
#include <limits>
#include <thread>
#include <utility>

#include "engine/core/child_process.h"
#include "engine/core/error.h"

namespace rowland {

namespace {

[[noreturn]] void fail_process(const std::filesystem::path& program, const std::string& what, int code) {
    fail_system(program.string(), fmt::format("{}: {}", what, std::strerror(code)),
                "install Rowland again, or free processes and files");
}

/// What exec() takes: the program and its arguments. `texts` must live as long as the result.
std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    for (std::string& text : texts) result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

/// Starts the program by posix_spawn: fork would copy page tables and the locks that the drivers' threads hold.
pid_t spawn(const std::filesystem::path& program, const std::vector<std::string>& arguments,
            const posix_spawn_file_actions_t* actions) {
    std::vector<std::string> texts{program.string()};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    pid_t process = -1;
    const int code = posix_spawn(&process, program.c_str(), actions, nullptr, pointers(texts).data(), environ);
    if (code != 0) fail_process(program, "cannot be started", code);
    return process;
}

/// With `standard_input`, and without standard output and error.
pid_t spawn_helper(const std::filesystem::path& program, int standard_input) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    const std::unique_ptr<posix_spawn_file_actions_t, int (*)(posix_spawn_file_actions_t*)> owner(
        &actions, posix_spawn_file_actions_destroy);
    posix_spawn_file_actions_adddup2(&actions, standard_input, STDIN_FILENO);
    for (const int output : {STDOUT_FILENO, STDERR_FILENO})
        posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
    return spawn(program, {}, &actions);
}

int reap(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) == -1 && errno == EINTR) {
    }
    return status;
}

}  // namespace

struct ChildProcess::State {
    explicit State(const std::filesystem::path& program) {
        std::array<int, 2> ends{};
        if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
            fail_process(program, "no socket", errno);
        try {
            process = spawn_helper(program, ends[1]);
        } catch (...) {
            close(ends[0]);
            close(ends[1]);
            throw;
        }
        close(ends[1]);
        socket = ends[0];
    }
    ~State() {
        close(socket);
        if (process == -1) return;
        kill(process, SIGKILL);
        reap(process);
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    /// Calls `transfer` until all bytes are sent or received.
    template <typename Byte, typename Transfer>
    Exchange exchange(std::span<Byte> bytes, short event, Deadline deadline, const Transfer& transfer) const {
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

    /// Waits for `event` or the end of the program, which the next exchange reports.
    Exchange wait(short event, Deadline deadline) const {
        while (true) {
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
            if (left.count() <= 0) return Exchange::Late;
            pollfd watched{socket, event, 0};
            const auto timeout = std::min<std::int64_t>(left.count(), std::numeric_limits<int>::max());
            const int ready = poll(&watched, 1, static_cast<int>(timeout));
            if (ready > 0) return Exchange::Done;
            if (ready < 0 && errno != EINTR) return Exchange::Ended;
        }
    }

    pid_t process = -1;  ///< −1: reaped
    int socket = -1;
};

ChildProcess::ChildProcess(const std::filesystem::path& program) : state_(std::make_unique<State>(program)) {}

ChildProcess::~ChildProcess() = default;

ChildProcess::Exchange ChildProcess::send(std::span<const std::byte> bytes, Deadline deadline) {
    return state_->exchange(bytes, POLLOUT, deadline, [&](const std::byte* data, std::size_t size) {
        return ::send(state_->socket, data, size, MSG_NOSIGNAL | MSG_DONTWAIT);
    });
}

ChildProcess::Exchange ChildProcess::receive(std::span<std::byte> bytes, Deadline deadline) {
    return state_->exchange(bytes, POLLIN, deadline, [&](std::byte* data, std::size_t size) {
        return recv(state_->socket, data, size, MSG_DONTWAIT);
    });
}

std::string ChildProcess::ending() {
    if (state_->process == -1) return "ended";
    kill(state_->process, SIGKILL);  // reap() must not wait; a process that is ending keeps its own status
    const int status = reap(std::exchange(state_->process, -1));
    if (WIFSIGNALED(status)) return fmt::format("ended by signal {}", WTERMSIG(status));
    return fmt::format("ended with code {}", WEXITSTATUS(status));
}

std::future<int> start_program(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    const pid_t process = spawn(program, arguments, nullptr);
    std::promise<int> exit_code;
    std::future<int> result = exit_code.get_future();
    std::thread([process, ended = std::move(exit_code)]() mutable {
        const int status = reap(process);
        ended.set_value(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
    }).detach();
    return result;
}

void continue_as(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> texts{program.filename().string()};
    texts.insert(texts.end(), arguments.begin(), arguments.end());
    execv(program.c_str(), pointers(texts).data());
    fail_process(program, "cannot be run", errno);
}

}  // namespace rowland

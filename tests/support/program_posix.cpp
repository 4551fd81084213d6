#include "tests/support/program.h"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <thread>

namespace rowland::test {

namespace {

/// A nameless file that output goes to.
using CaptureFile = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

CaptureFile open_capture() {
    CaptureFile file(std::tmpfile(), std::fclose);
    if (!file) throw std::runtime_error("no temporary file");
    return file;
}

/// Everything in it. Its position stays, which a program that still writes shares.
std::string content(std::FILE* file) {
    std::string text;
    std::array<char, 4096> buffer;
    for (ssize_t size = 0;
         (size = ::pread(::fileno(file), buffer.data(), buffer.size(), static_cast<off_t>(text.size()))) > 0;)
        text.append(buffer.data(), static_cast<std::size_t>(size));
    return text;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
    std::vector<char*> result;
    result.reserve(texts.size() + 1);
    for (std::string& text : texts) result.push_back(text.data());
    result.push_back(nullptr);
    return result;
}

/// "NAME=value" of this program's environment, with the changes.
std::vector<std::string> environment_with(std::map<std::string, std::optional<std::string>> changes,
                                          const Surroundings& surroundings) {
    if (!surroundings.preload.empty()) changes["LD_PRELOAD"] = surroundings.preload;
    // A program with sanitizers wants to be the first otherwise; one that is traced cannot look for its leaks.
    if (!surroundings.preload.empty()) changes["ASAN_OPTIONS"] = "verify_asan_link_order=0";
    if (surroundings.traced) changes["ASAN_OPTIONS"] = "detect_leaks=0";
    std::vector<std::string> result;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string text = *entry;
        if (!changes.contains(text.substr(0, text.find('=')))) result.push_back(text);
    }
    for (const auto& [name, value] : changes)
        if (value) result.push_back(name + "=" + *value);
    return result;
}

int exit_code(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

struct Running::State {
    CaptureFile out = open_capture();
    CaptureFile err = open_capture();
    pid_t pid = -1;
    bool waited_for = false;
    std::chrono::seconds limit{0};
};

Running::Running(const Command& command, const Surroundings& surroundings) : state_(std::make_unique<State>()) {
    // All is made before the fork: between it and exec only what is safe in a program of many threads may be called.
    std::vector<std::string> arguments = command;
    std::vector<std::string> variables = environment_with(surroundings.environment, surroundings);
    const std::vector<char*> argument_pointers = pointers(arguments);
    const std::vector<char*> variable_pointers = pointers(variables);
    state_->limit = surroundings.limit;
    const int out = ::fileno(state_->out.get());
    const int err = ::fileno(state_->err.get());
    state_->pid = ::fork();
    if (state_->pid < 0) throw std::runtime_error("cannot fork");
    // A group of its own, set by whoever comes first: what it starts ends with it.
    ::setpgid(state_->pid, state_->pid);
    if (state_->pid > 0) return;

    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(surroundings.output.empty() ? out : ::open(surroundings.output.c_str(), O_WRONLY), STDOUT_FILENO);
    ::dup2(err, STDERR_FILENO);
    if (!surroundings.folder.empty() && ::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
    if (surroundings.obey_modes) {
        ::prctl(PR_CAPBSET_DROP, CAP_DAC_OVERRIDE);
        ::prctl(PR_CAPBSET_DROP, CAP_DAC_READ_SEARCH);
    }
    if (surroundings.traced) ::ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
    ::execve(argument_pointers[0], argument_pointers.data(), variable_pointers.data());
    ::_exit(127);
}

Running::~Running() {
    if (state_->waited_for) return;
    ::kill(-state_->pid, SIGKILL);
    ::waitpid(state_->pid, nullptr, __WALL);
}

pid_t Running::pid() const {
    return state_->pid;
}

bool Running::alive() const {
    siginfo_t info = {};
    return ::waitid(P_PID, static_cast<id_t>(state_->pid), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

std::string Running::err() const {
    return content(state_->err.get());
}

void Running::kill() {
    ::kill(state_->pid, SIGKILL);
}

Ended Running::wait() {
    const auto deadline = std::chrono::steady_clock::now() + state_->limit;
    int status = 0;
    rusage used = {};
    bool too_long = false;
    while (::wait4(state_->pid, &status, too_long ? 0 : WNOHANG, &used) == 0) {
        if (std::chrono::steady_clock::now() > deadline) {
            too_long = true;
            ::kill(-state_->pid, SIGKILL);
            continue;
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    Ended result = ended(status);
    result.peak_bytes = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
    result.too_long = too_long;
    return result;
}

Ended Running::ended(int status) const {
    state_->waited_for = true;
    Ended result;
    result.code = exit_code(status);
    result.out = content(state_->out.get());
    result.err = content(state_->err.get());
    return result;
}

}  // namespace rowland::test

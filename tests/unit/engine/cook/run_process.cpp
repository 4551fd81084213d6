#include "tests/unit/engine/cook/run_process.h"

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <stdexcept>

#include "tests/support/capture_file.h"

namespace rowland::test {

BackgroundProcess::BackgroundProcess(const std::vector<std::string>& command)
    : out_(open_capture()), err_(open_capture()) {
    std::vector<char*> arguments;
    arguments.reserve(command.size() + 1);
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    child_ = ::fork();
    if (child_ < 0) throw std::runtime_error("cannot fork");
    if (child_ == 0) {
        ::dup2(::fileno(out_.get()), STDOUT_FILENO);
        ::dup2(::fileno(err_.get()), STDERR_FILENO);
        ::execv(arguments[0], arguments.data());
        ::_exit(127);
    }
}

BackgroundProcess::~BackgroundProcess() {
    if (child_ < 0) return;
    kill();
    ::waitpid(child_, nullptr, 0);
}

void BackgroundProcess::kill() {
    ::kill(child_, SIGKILL);
}

ProcessResult BackgroundProcess::wait() {
    int status = 0;
    ::waitpid(child_, &status, 0);
    child_ = -1;
    ProcessResult result;
    result.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    result.out = content(out_.get());
    result.err = content(err_.get());
    return result;
}

ProcessResult run_process(const std::vector<std::string>& command) {
    return BackgroundProcess(command).wait();
}

}  // namespace rowland::test

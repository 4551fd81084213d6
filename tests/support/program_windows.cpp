#include <windows.h>
//
#include <psapi.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "engine/core/windows_text.h"
#include "tests/support/files.h"
#include "tests/support/program.h"

namespace rowland::test {

namespace {

/// A file that the child can write to while this process reads it.
HANDLE open_output(const std::filesystem::path& file) {
    SECURITY_ATTRIBUTES inherited{sizeof inherited, nullptr, TRUE};
    const HANDLE handle =
        CreateFileW(file.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, &inherited,
                    OPEN_ALWAYS, FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE) throw std::runtime_error("cannot open " + file.string());
    return handle;
}

std::string content(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// "NAME=value" with a zero behind each, as CreateProcessW() takes it: this program's environment with the changes.
std::wstring environment_with(std::map<std::string, std::optional<std::string>> changes) {
    std::wstring block;
    wchar_t* const own = GetEnvironmentStringsW();
    for (const wchar_t* entry = own; *entry != L'\0'; entry += std::wcslen(entry) + 1) {
        const std::wstring text = entry;
        // Names of folders per drive begin with '='.
        if (!changes.contains(utf8(text.substr(0, text.find(L'=', 1))))) block += text + L'\0';
    }
    FreeEnvironmentStringsW(own);
    for (const auto& [name, value] : changes)
        if (value) block += utf16(name + "=" + *value) + L'\0';
    return block + L'\0';
}

}  // namespace

struct Running::State {
    ~State() {
        // The job also ends what the program started.
        if (job != nullptr) CloseHandle(job);
        if (process != nullptr) CloseHandle(process);
    }

    TemporaryFolder folder;
    std::filesystem::path out = folder.path() / "out";
    std::filesystem::path err = folder.path() / "err";
    HANDLE process = nullptr;
    HANDLE job = nullptr;
    DWORD id = 0;
    std::chrono::seconds limit{0};
};

Running::Running(const Command& command, const Surroundings& surroundings) : state_(std::make_unique<State>()) {
    if (!surroundings.preload.empty() || surroundings.obey_modes || surroundings.traced)
        throw std::runtime_error("Windows has neither preloaded libraries nor modes nor ptrace");
    state_->limit = surroundings.limit;
    const std::filesystem::path program(utf16(command.at(0)));
    std::wstring line = command_line(program, {command.begin() + 1, command.end()});
    std::wstring environment = environment_with(surroundings.environment);
    STARTUPINFOW startup{};
    startup.cb = sizeof startup;
    startup.dwFlags = STARTF_USESTDHANDLES;
    startup.hStdOutput = open_output(surroundings.output.empty() ? state_->out : surroundings.output);
    startup.hStdError = open_output(state_->err);
    PROCESS_INFORMATION started{};
    state_->job = CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    SetInformationJobObject(state_->job, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    const BOOL ok = CreateProcessW(
        nullptr, line.data(), nullptr, nullptr, TRUE, CREATE_SUSPENDED | CREATE_UNICODE_ENVIRONMENT, environment.data(),
        surroundings.folder.empty() ? nullptr : surroundings.folder.c_str(), &startup, &started);
    const std::error_code reason = last_windows_failure();
    CloseHandle(startup.hStdOutput);
    CloseHandle(startup.hStdError);
    if (ok == 0) throw std::runtime_error(program.string() + ": " + reason.message());
    state_->process = started.hProcess;
    state_->id = started.dwProcessId;
    AssignProcessToJobObject(state_->job, state_->process);
    ResumeThread(started.hThread);
    CloseHandle(started.hThread);
}

Running::~Running() {
    kill();
}

pid_t Running::pid() const {
    return static_cast<pid_t>(state_->id);
}

bool Running::alive() const {
    return WaitForSingleObject(state_->process, 0) == WAIT_TIMEOUT;
}

std::string Running::err() const {
    return content(state_->err);
}

void Running::kill() {
    TerminateJobObject(state_->job, 128 + 9);  // as of SIGKILL
}

Ended Running::wait() {
    const auto limit_ms = std::chrono::duration_cast<std::chrono::milliseconds>(state_->limit).count();
    const bool too_long = WaitForSingleObject(state_->process, static_cast<DWORD>(limit_ms)) == WAIT_TIMEOUT;
    if (too_long) kill();
    WaitForSingleObject(state_->process, INFINITE);
    DWORD code = 0;
    GetExitCodeProcess(state_->process, &code);
    Ended result = ended(static_cast<int>(code));
    PROCESS_MEMORY_COUNTERS counters{};
    K32GetProcessMemoryInfo(state_->process, &counters, sizeof counters);
    result.peak_bytes = counters.PeakWorkingSetSize;
    result.too_long = too_long;
    return result;
}

Ended Running::ended(int status) const {
    Ended result;
    result.code = status;
    result.out = content(state_->out);
    result.err = content(state_->err);
    return result;
}

}  // namespace rowland::test

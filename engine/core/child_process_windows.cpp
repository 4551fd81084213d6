#include <fmt/format.h>
#include <windows.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <thread>
#include <utility>

#include "engine/core/child_process.h"
#include "engine/core/error.h"
#include "engine/core/windows_text.h"

namespace rowland {

namespace {

/// A handle that is closed with it.
class Handle {
 public:
    explicit Handle(HANDLE handle = nullptr) : handle_(handle == INVALID_HANDLE_VALUE ? nullptr : handle) {}
    Handle(Handle&& other) noexcept : handle_(std::exchange(other.handle_, nullptr)) {}
    Handle& operator=(Handle&& other) noexcept {
        std::swap(handle_, other.handle_);
        return *this;
    }
    ~Handle() {
        if (handle_ != nullptr) CloseHandle(handle_);
    }
    HANDLE get() const { return handle_; }
    explicit operator bool() const { return handle_ != nullptr; }

 private:
    HANDLE handle_;
};

[[noreturn]] void fail_process(const std::filesystem::path& program, const std::string& what) {
    const std::error_code reason = last_windows_failure();
    fail_system(program.string(), fmt::format("{}: {}", what, reason.message()),
                "install Rowland again, or free processes and files");
}

struct Streams {
    HANDLE in = nullptr;
    HANDLE out = nullptr;
    HANDLE err = nullptr;
};

struct Started {
    Handle process;
    Handle thread;
};

/// Starts a program that inherits the streams and no other handle.
Started launch(std::filesystem::path program, const std::vector<std::string>& arguments, const Streams& streams,
               DWORD flags) {
    if (program.extension() != ".exe") program += ".exe";
    std::wstring command = command_line(program, arguments);

    std::vector<HANDLE> inherited;
    for (HANDLE stream : {streams.in, streams.out, streams.err})
        if (stream != nullptr && stream != INVALID_HANDLE_VALUE &&
            std::ranges::find(inherited, stream) == inherited.end() &&
            SetHandleInformation(stream, HANDLE_FLAG_INHERIT, HANDLE_FLAG_INHERIT) != 0)
            inherited.push_back(stream);
    SIZE_T size = 0;
    InitializeProcThreadAttributeList(nullptr, 1, 0, &size);
    std::vector<std::byte> memory(size);
    auto* const attributes = reinterpret_cast<LPPROC_THREAD_ATTRIBUTE_LIST>(memory.data());
    if (InitializeProcThreadAttributeList(attributes, 1, 0, &size) == 0) fail_process(program, "cannot be started");
    STARTUPINFOEXW startup{};
    startup.StartupInfo.cb = sizeof startup;
    startup.StartupInfo.dwFlags = STARTF_USESTDHANDLES;
    startup.StartupInfo.hStdInput = streams.in;
    startup.StartupInfo.hStdOutput = streams.out;
    startup.StartupInfo.hStdError = streams.err;
    startup.lpAttributeList = attributes;
    if (!inherited.empty())
        UpdateProcThreadAttribute(attributes, 0, PROC_THREAD_ATTRIBUTE_HANDLE_LIST, inherited.data(),
                                  inherited.size() * sizeof(HANDLE), nullptr, nullptr);
    PROCESS_INFORMATION started{};
    const BOOL ok =
        CreateProcessW(program.c_str(), command.data(), nullptr, nullptr, inherited.empty() ? FALSE : TRUE,
                       flags | EXTENDED_STARTUPINFO_PRESENT, nullptr, nullptr, &startup.StartupInfo, &started);
    const DWORD reason = GetLastError();
    DeleteProcThreadAttributeList(attributes);
    SetLastError(reason);
    if (ok == 0) fail_process(program, "cannot be started");
    return {Handle(started.hProcess), Handle(started.hThread)};
}

Started launch_with_own_streams(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    return launch(program, arguments,
                  {GetStdHandle(STD_INPUT_HANDLE), GetStdHandle(STD_OUTPUT_HANDLE), GetStdHandle(STD_ERROR_HANDLE)}, 0);
}

DWORD wait_for_exit_code(HANDLE process) {
    WaitForSingleObject(process, INFINITE);
    DWORD code = 0;
    GetExitCodeProcess(process, &code);
    return code;
}

}  // namespace

/// The channel is a named pipe, as anonymous pipes know no deadlines. The job ends the helper when its last handle is
/// closed, and so when this process is killed.
struct ChildProcess::State {
    explicit State(const std::filesystem::path& program) {
        static std::atomic<std::uint32_t> count{0};
        const std::wstring name =
            utf16(fmt::format(R"(\\.\pipe\rowland-{}-{})", GetCurrentProcessId(), count.fetch_add(1)));
        constexpr DWORD kBuffer = 1 << 16;
        pipe = Handle(CreateNamedPipeW(name.c_str(),
                                       PIPE_ACCESS_DUPLEX | FILE_FLAG_OVERLAPPED | FILE_FLAG_FIRST_PIPE_INSTANCE,
                                       PIPE_TYPE_BYTE | PIPE_WAIT, 1, kBuffer, kBuffer, 0, nullptr));
        const Handle helper_end(
            CreateFileW(name.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_EXISTING, 0, nullptr));
        const Handle nothing(
            CreateFileW(L"NUL", GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr, OPEN_EXISTING, 0, nullptr));
        event = Handle(CreateEventW(nullptr, TRUE, FALSE, nullptr));
        job = Handle(CreateJobObjectW(nullptr, nullptr));
        if (!pipe || !helper_end || !nothing || !event || !job) fail_process(program, "no pipe");
        JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
        limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
        SetInformationJobObject(job.get(), JobObjectExtendedLimitInformation, &limits, sizeof limits);
        Started started =
            launch(program, {}, {helper_end.get(), nothing.get(), nothing.get()}, CREATE_SUSPENDED | CREATE_NO_WINDOW);
        process = std::move(started.process);
        AssignProcessToJobObject(job.get(), process.get());
        ResumeThread(started.thread.get());
    }
    ~State() {
        if (process) end_process();
    }
    State(const State&) = delete;
    State& operator=(const State&) = delete;

    DWORD end_process() {
        // A process that is ending keeps its own code.
        TerminateProcess(process.get(), 1);
        const DWORD code = wait_for_exit_code(process.get());
        process = Handle();
        return code;
    }

    /// Calls `transfer`, which begins to read or write, until all bytes have passed.
    template <typename Byte, typename Transfer>
    Exchange exchange(std::span<Byte> bytes, Deadline deadline, const Transfer& transfer) const {
        while (!bytes.empty()) {
            OVERLAPPED operation{};
            operation.hEvent = event.get();
            const auto size = static_cast<DWORD>(std::min<std::size_t>(bytes.size(), 1 << 16));
            if (transfer(bytes.data(), size, &operation) == 0 && GetLastError() != ERROR_IO_PENDING)
                return Exchange::Ended;
            const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
            const auto timeout = std::clamp<std::int64_t>(left.count(), 0, 0x7fffffff);
            const bool late = WaitForSingleObject(event.get(), static_cast<DWORD>(timeout)) == WAIT_TIMEOUT;
            if (late) CancelIoEx(pipe.get(), &operation);
            DWORD count = 0;
            const bool ok = GetOverlappedResult(pipe.get(), &operation, &count, TRUE) != 0;
            bytes = bytes.subspan(count);
            if (late && !bytes.empty()) return Exchange::Late;
            if (!ok || count == 0) return Exchange::Ended;
        }
        return Exchange::Done;
    }

    Handle pipe;
    Handle event;
    Handle job;
    Handle process;  ///< none: its end was reported
};

ChildProcess::ChildProcess(const std::filesystem::path& program) : state_(std::make_unique<State>(program)) {}

ChildProcess::~ChildProcess() = default;

ChildProcess::Exchange ChildProcess::send(std::span<const std::byte> bytes, Deadline deadline) {
    return state_->exchange(bytes, deadline, [&](const std::byte* data, DWORD size, OVERLAPPED* operation) {
        return WriteFile(state_->pipe.get(), data, size, nullptr, operation);
    });
}

ChildProcess::Exchange ChildProcess::receive(std::span<std::byte> bytes, Deadline deadline) {
    return state_->exchange(bytes, deadline, [&](std::byte* data, DWORD size, OVERLAPPED* operation) {
        return ReadFile(state_->pipe.get(), data, size, nullptr, operation);
    });
}

std::string ChildProcess::ending() {
    if (!state_->process) return "ended";
    const DWORD code = state_->end_process();
    constexpr DWORD kExceptions = 0xc0000000;  // codes from here on are those of NTSTATUS errors
    return code >= kExceptions ? fmt::format("ended by exception {:#x}", code)
                               : fmt::format("ended with code {}", code);
}

std::future<int> start_program(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    Started started = launch_with_own_streams(program, arguments);
    std::promise<int> exit_code;
    std::future<int> result = exit_code.get_future();
    std::thread([process = std::move(started.process), ended = std::move(exit_code)]() mutable {
        ended.set_value(static_cast<int>(wait_for_exit_code(process.get())));
    }).detach();
    return result;
}

void continue_as(const std::filesystem::path& program, const std::vector<std::string>& arguments) {
    const Started started = launch_with_own_streams(program, arguments);
    std::exit(static_cast<int>(wait_for_exit_code(started.process.get())));
}

}  // namespace rowland

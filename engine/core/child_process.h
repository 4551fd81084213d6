#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <future>
#include <memory>
#include <span>
#include <string>
#include <vector>

// Programs that this one starts: child_process_posix.cpp, child_process_windows.cpp.
namespace rowland {

/// A helper program for work that may crash, hang or exhaust memory. Both sides exchange bytes through the helper's
/// standard input (helper_process.h); its standard output and error are discarded. The destructor kills it.
class ChildProcess {
 public:
    using Deadline = std::chrono::steady_clock::time_point;
    enum class Exchange { Done, Ended, Late };

    /// Throws Error (system) if the program cannot be started.
    explicit ChildProcess(const std::filesystem::path& program);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Sends all bytes to the program. Ended: the program has ended; Late: it did not take them by the deadline.
    Exchange send(std::span<const std::byte> bytes, Deadline deadline);
    /// Fills `bytes` with what the program sends. Ended and Late as for send().
    Exchange receive(std::span<std::byte> bytes, Deadline deadline);
    /// How the program ended: "ended by signal 11", "ended by exception 0xc0000005", "ended with code 1"; "ended" if it
    /// was asked before. Kills a program that still runs.
    std::string ending();

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Starts a program with its arguments; it has the standard streams of this one and outlives it. Returns its exit code
/// when it ends, −1 if a signal ended it. Throws Error (system) if it cannot be started.
std::future<int> start_program(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// Ends this program with the exit code that `program` ends with; on POSIX systems it takes this one's place. Throws
/// Error (system) if it cannot be started.
[[noreturn]] void continue_as(const std::filesystem::path& program, const std::vector<std::string>& arguments);

}  // namespace rowland

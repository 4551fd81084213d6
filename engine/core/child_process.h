#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace rowland {

/// A program of ours that runs beside us, for work that may crash, hang or swallow memory. It talks with us through its
/// standard input, which is a socket; its standard output and error go nowhere. It is killed at the end of the scope.
class ChildProcess {
 public:
    using Deadline = std::chrono::steady_clock::time_point;
    enum class Exchange { Done, Ended, Late };

    /// Throws Error (system) if the program cannot be started.
    explicit ChildProcess(const std::filesystem::path& program);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Hands all bytes to the program. Ended: it is gone; Late: it did not take them by the deadline.
    Exchange send(std::span<const std::byte> bytes, Deadline deadline);
    /// Fills `bytes` with what the program sends.
    Exchange receive(std::span<std::byte> bytes, Deadline deadline);
    /// How the program that has Ended did so: "ended by signal 11", "ended with code 1".
    std::string ending();

 private:
    Exchange wait(short event, Deadline deadline) const;
    int reap();

    pid_t process_ = -1;  ///< −1: reaped
    int socket_ = -1;
};

/// Where the helper program `name` is: in the folder $ROWLAND_HELPER_FOLDER names, else beside the running program, in
/// ../libexec/rowland from there, or in the folder the library was built to be installed to. Throws Error (system) if
/// in none of them.
std::filesystem::path helper_program(const std::string& name);

}  // namespace rowland

#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace rowland {

/// Runs a program's body. The exit code is what `body` returns, 2 for bad input or usage, or 1 for any other failure,
/// such as results that could not be written. Errors are printed as one line on standard error.
int run_program(const std::function<int()>& body);

/// "PROGRAM 0.1.0, commit 0123456789ab, GNU 12.2.0 Release". The commit is read from a file that the build writes
/// ("unknown" if it is missing) and not compiled in: a program that changed with each commit would cook all assets
/// again.
std::string version_text(const std::string& program);

/// A helper program for work that may crash, hang or exhaust memory. Both sides exchange bytes over a socket, which is
/// the helper's standard input; its standard output and error are discarded. The destructor kills it.
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
    /// How the program ended: "ended by signal 11", "ended with code 1"; "ended" if it was asked before. Kills a
    /// program that still runs.
    std::string ending();

 private:
    template <typename Byte, typename Transfer>
    Exchange exchange(std::span<Byte> bytes, short event, Deadline deadline, const Transfer& transfer);
    Exchange wait(short event, Deadline deadline) const;
    int reap();

    pid_t process_ = -1;  ///< −1: reaped
    int socket_ = -1;
};

/// The folder of helper programs that the library was built for. Weak: find_package(Rowland) defines it for other
/// projects' programs as the folder of the package it found.
const char* installed_helper_folder();

/// The path of the helper program `name`: in the folder $ROWLAND_HELPER_FOLDER, else beside the running program or the
/// shared library that holds this code, in the installation's folder relative to either (../libexec/rowland), or in
/// installed_helper_folder(). Throws Error (system) if it is in none of them.
std::filesystem::path helper_program(const std::string& name);

}  // namespace rowland

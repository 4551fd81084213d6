#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::test {

/// A program and its arguments, as they are (no shell).
using Command = std::vector<std::string>;

/// A program and arguments between spaces; an argument in single quotes may hold spaces, or be empty.
Command command(const std::string& program, std::string_view arguments);

/// What a program is run in.
struct Surroundings {
    std::map<std::string, std::optional<std::string>> environment{};  ///< set, or unset where there is no value
    std::string preload{};                                            ///< a library that comes before all others
    std::filesystem::path folder{};                                   ///< empty: this one
    std::filesystem::path output{};  ///< that standard output goes to, a device as well; empty: it is kept
    bool obey_modes = false;         ///< modes also bind the superuser
    bool traced = false;             ///< by the thread that starts it, and stopped before its first instruction
    std::chrono::seconds limit{120};
};

struct Ended {
    int code = -1;  ///< exit code; 128 + number if a signal ended it
    std::string out;
    std::string err;
    std::uint64_t peak_bytes = 0;  ///< of resident memory
    bool too_long = false;         ///< it was killed at its limit
};

/// A program that has been started; killed when it goes out of scope.
class Running {
 public:
    explicit Running(const Command& command, const Surroundings& surroundings = {});
    ~Running();
    Running(const Running&) = delete;
    Running& operator=(const Running&) = delete;

    pid_t pid() const;
    bool alive() const;
    /// What it has written to standard error until now.
    std::string err() const;
    void kill();
    /// Waits for its end, at most to its limit.
    Ended wait();
    /// What it wrote, once somebody else has waited for it.
    Ended ended(int status) const;

 private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Runs a program to its end.
Ended run(const Command& command, const Surroundings& surroundings = {});

}  // namespace rowland::test

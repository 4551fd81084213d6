#pragma once

#include <functional>

#include "tests/support/program.h"

namespace rowland::test {

/// What was about to happen when a program was stopped.
struct Moment {
    int number = 0;    ///< from 0
    std::string call;  ///< of the system: "openat", "write", "rename" …
};

/// What is done while the program stands still; false: it is killed, as by `kill -9`.
using Intervention = std::function<bool(const Moment&)>;

/// Runs a program that stops at every moment: before each system call about a file in `folder` (which names it, or
/// has it open). Between two of them nothing that it does can be seen from outside, nor can it see anything, so what
/// holds at all of these moments holds at any time. The program should use one thread for its files.
Ended run_with_moments(const Command& command, const std::filesystem::path& folder, const Intervention& intervene,
                       Surroundings surroundings = {});

}  // namespace rowland::test

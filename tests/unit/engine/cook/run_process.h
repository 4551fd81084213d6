#pragma once

#include <string>
#include <vector>

namespace rowland::test {

struct ProcessResult {
    int code = -1;  ///< exit code; 128 + number if a signal ended it
    std::string out;
    std::string err;
};

/// Runs a program, its arguments as they are (no shell), to its end.
ProcessResult run_process(const std::vector<std::string>& command);

}  // namespace rowland::test

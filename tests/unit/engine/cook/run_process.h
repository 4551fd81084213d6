#pragma once

#include <sys/types.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/capture_file.h"

namespace rowland::test {

struct ProcessResult {
    int code = -1;  ///< exit code; 128 + number if a signal ended it
    std::string out;
    std::string err;
};

/// Runs a program, its arguments as they are (no shell), to its end.
ProcessResult run_process(const std::vector<std::string>& command);

/// A program that runs beside us. If it has not been waited for, it is killed at the end of the scope.
class BackgroundProcess {
 public:
    /// As run_process.
    explicit BackgroundProcess(const std::vector<std::string>& command);
    ~BackgroundProcess();
    BackgroundProcess(const BackgroundProcess&) = delete;
    BackgroundProcess& operator=(const BackgroundProcess&) = delete;

    void kill();  ///< as by kill -9
    ProcessResult wait();

 private:
    CaptureFile out_;
    CaptureFile err_;
    pid_t child_;
};

}  // namespace rowland::test

#pragma once

#include <functional>

namespace rowland {

/// Runs a program's body with the exit codes all our programs share: what `body` returns, 2 for bad input or usage,
/// 1 for any other failure, results that could not be written included. Errors are printed as one line on standard
/// error.
int run_program(const std::function<int()>& body);

}  // namespace rowland

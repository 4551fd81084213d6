#pragma once

#include <functional>

namespace rowland {

/// Runs a program's body. The exit code is what `body` returns, 2 for bad input or usage, or 1 for any other failure,
/// such as results that could not be written. Errors are printed as one line on standard error.
int run_program(const std::function<int()>& body);

}  // namespace rowland

#pragma once

#include <CLI/CLI.hpp>

namespace rowland {

/// A check for CLI11: a number from `least` to `most`. It also refuses NaN, which CLI::Range lets pass.
CLI::Validator finite(double least, double most);

/// Parses the command line. For --help and --version prints the help or version_text() and returns false. Throws Error
/// (input) for bad usage, which includes an empty argument or an option without its value ("--option=").
bool parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace rowland

#pragma once

#include <CLI/CLI.hpp>

namespace rowland {

/// A check for CLI11: a number within `least` to `most`. Refuses NaN and infinities, which CLI::Range lets pass.
CLI::Validator finite(double least, double most);

/// Parses the command line. Prints help or, for --version, version_text() and returns false if only that was asked for.
/// Throws Error (input) for bad usage; an argument that is empty, as "--option=" is, names nothing and is refused.
bool parse_command_line(CLI::App& app, int argc, const char* const* argv);

}  // namespace rowland

#pragma once

#include <string>

namespace CLI {
class App;
}

namespace rowland::trade {

/// Each adds a subcommand that runs where the command line names it.

/// `project`: the raw radiance SH of a probe on standard output.
void add_project_command(CLI::App& program);
/// `sweep`: errors, times, counts and bytes of many settings, as CSV and JSON lines in a folder.
/// `report`: the same, drawn into one HTML file with the paper's own figures.
/// `command_line`: for the report, as it was typed.
void add_sweep_commands(CLI::App& program, const std::string& command_line);

}  // namespace rowland::trade

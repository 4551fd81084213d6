#pragma once

#include <string>

namespace CLI {
class App;
}

namespace rowland::trade {

/// Adds the option --probe-mapping: "auto", "equirect" or "angular".
void add_probe_mapping(CLI::App& command, std::string& mapping);

// Each function below adds a subcommand, which runs if the command line names it.

/// `evaluate`: XYZ of a material at given frames, by any method, on standard output.
void add_evaluate_command(CLI::App& program);
/// `sweep`: errors, times, counts and bytes of many settings, as CSV and JSON lines in a folder.
/// `report`: the same, drawn into one HTML file with the paper's own figures.
/// `command_line`: for the report, as it was typed.
void add_sweep_commands(CLI::App& program, const std::string& command_line);

/// `films`: a picture of the colours of thin films, and the errors of common formulas.
void add_films_command(CLI::App& program);

/// `rigorous`: efficiencies of a material's orders by Maxwell's equations, as CSV.
void add_rigorous_command(CLI::App& program);

}  // namespace rowland::trade

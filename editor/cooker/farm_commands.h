#pragma once

#include "engine/cook/registry.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace rowland::editor {

/// Adds `plan`, which lists what to cook as jobs that many workers can share, and `run`, which does jobs of a plan
/// beside other workers. They run where the command line names them; `run` sets `exit_code` to 2 if a job's sources
/// were refused, else to 1 if a job failed otherwise. Both arguments must outlive the program.
void add_farm_commands(CLI::App& program, const cook::Registry& registry, int& exit_code);

void add_threads_option(CLI::App& command, unsigned& threads);

}  // namespace rowland::editor

#pragma once

#include <initializer_list>

#include "engine/cook/registry.h"

namespace CLI {
class App;
}

namespace rowland::editor {

/// Adds a subcommand.
using AddCommand = void (*)(CLI::App& program);

/// The program rowland-cook over the asset types in `registry`, with the subcommands `cook`, `check`, `info`, `schema`,
/// `attach`, `list`, `plan`, `run` and those that `more` adds. Results go to standard output, messages to standard
/// error. Returns the exit code: 0 success, 2 bad input or usage, 1 any other failure.
int run_cooker(int argc, const char* const* argv, const cook::Registry& registry,
               std::initializer_list<AddCommand> more = {});

}  // namespace rowland::editor

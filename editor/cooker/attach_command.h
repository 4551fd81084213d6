#pragma once

#include <CLI/CLI.hpp>

#include "engine/cook/registry.h"

namespace rowland::editor {

/// Adds the commands `attach`, which sets material extensions of a glTF in place, and `list`, which prints them.
void add_attach_commands(CLI::App& program, const cook::Registry& registry, int& exit_code);

}  // namespace rowland::editor

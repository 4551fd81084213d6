#pragma once

#include "engine/cook/registry.h"

namespace rowland::editor {

/// The program rowland-cook over the asset types in `registry`: `cook`, `check`, `info`, `attach`, `list`, `plan` and
/// `run`. Results on standard output, messages on standard error. Returns the exit code: 0 success, 2 bad input or
/// usage, 1 any other failure.
int run_cooker(int argc, const char* const* argv, const cook::Registry& registry);

}  // namespace rowland::editor

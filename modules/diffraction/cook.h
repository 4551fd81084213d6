#pragma once

#include "engine/cook/registry.h"

namespace rowland::diffraction {

/// Registers "material": a grating material's JSON, cooked to its view table.
void register_cook_types(cook::Registry& registry);

}  // namespace rowland::diffraction

#pragma once

#include "engine/cook/registry.h"

namespace rowland::diffraction {

/// Registers "material": a grating material's JSON, cooked to the tables that it pins, or to the cheapest that its
/// max_error allows.
void register_cook_types(cook::Registry& registry);

}  // namespace rowland::diffraction

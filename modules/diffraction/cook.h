#pragma once

#include "engine/cook/registry.h"

namespace rowland::diffraction {

/// Adds the glTF extension and the asset type "material": a grating material's JSON, cooked to the tables that it pins,
/// or to the cheapest that its max_error allows.
void register_module(cook::Registry& registry);

}  // namespace rowland::diffraction

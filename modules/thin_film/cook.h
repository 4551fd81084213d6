#pragma once

#include "engine/cook/registry.h"

namespace rowland::thin_film {

/// Adds the glTF extensions KHR_materials_iridescence and KHR_materials_ior, and the asset type "film": a film
/// material's JSON, cooked to its table.
void register_module(cook::Registry& registry);

}  // namespace rowland::thin_film

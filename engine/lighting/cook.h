#pragma once

#include "engine/cook/registry.h"

namespace rowland::lighting {

/// Registers "probe" (recipes, `.probe`) and "probe image" (raw .hdr, .pic and .exr, checked but not cooked).
void register_cook_types(cook::Registry& registry);

}  // namespace rowland::lighting

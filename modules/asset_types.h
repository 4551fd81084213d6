#pragma once

#include <memory>

#include "engine/cook/registry.h"

namespace rowland::modules {

/// The asset types of the engine and of every module.
std::shared_ptr<const cook::Registry> asset_types();

}  // namespace rowland::modules

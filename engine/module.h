#pragma once

#include <initializer_list>
#include <memory>

#include "engine/cook/registry.h"

namespace rowland {

/// A module has two functions with the same name (engine/MODULES.md), so that programs which only read and cook files
/// need no OpenGL:
///     void register_module(cook::Registry&);    its asset types and glTF extensions
///     void register_module(render::Renderer&);  its material types, which hold components and per-frame systems
using RegisterAssets = void (*)(cook::Registry&);

/// The asset types of the engine and of these modules.
std::shared_ptr<const cook::Registry> make_registry(std::initializer_list<RegisterAssets> modules);

}  // namespace rowland

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/platform/input.h"

namespace rowland::platform {

/// The label of a key, as "W", "F5" or "Left Shift". Unique.
std::string name_of(Key key);
std::optional<Key> key_named(std::string_view name);

/// The key of a GLFW number; nullopt for one that Key does not have.
std::optional<Key> key_of_glfw(int glfw);

}  // namespace rowland::platform

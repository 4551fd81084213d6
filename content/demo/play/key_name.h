#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/platform/input.h"

namespace rowland::demo {

/// The label of a key, as "W", "F5" or "Left Shift", for help and recordings. Unique.
std::string name_of(platform::Key key);
/// The key of that name; nullopt if there is none.
std::optional<platform::Key> key_named(std::string_view name);

}  // namespace rowland::demo

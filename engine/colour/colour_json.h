#pragma once

#include <string>
#include <variant>

#include "engine/colour/illuminant.h"
#include "engine/colour/metal.h"
#include "engine/core/json_reader.h"

namespace rowland::colour {

/// The metal that "metal" names. Throws Error (input) that lists the known ones.
Metal read_metal(JsonReader& json);

/// The built-in illuminant that "illuminant" names; D65 without it. Throws Error (input) that lists them.
Illuminant read_builtin_illuminant(JsonReader& json);

/// The same, or the name of a .csv file, which the caller loads. `owner`, for messages: what the file lies beside, as
/// in "the material".
std::variant<Illuminant, std::string> read_illuminant(JsonReader& json, const std::string& owner);

}  // namespace rowland::colour

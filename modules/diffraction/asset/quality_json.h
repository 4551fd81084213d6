#pragma once

#include <variant>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

/// Parses a material's "quality": a tolerated error, or a representation with its settings. Unknown keys, and settings
/// that do not suit the grating (refusal()), are errors that name the key. `read` reads an illuminant's file. Throws
/// Error (input).
Quality parse_quality(JsonReader json, const Grating& grating, const ReadNamed& read);

/// A representation and its settings, within their limits.
struct ReadSettings {
    const RepresentationInfo& info;
    SettingValues values;
};
/// Reads "representation" and its settings from a "quality". Throws Error (input).
ReadSettings read_settings(JsonReader& json);

/// The quality that pins "representation" with its settings and "key_lights", as a budget, an editor or the demo
/// proposes it, or why a baked material of this grating cannot have it. The settings must be within their limits.
std::variant<Quality, Refusal> suited_quality(const nlohmann::json& settings, const Grating& grating);

}  // namespace rowland::diffraction

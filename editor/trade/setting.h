#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::trade {

/// A point of the trade between speed and accuracy: how a material is shaded, and how its light is divided.
struct Setting {
    /// A material file's "quality" but for key_lights: "representation" and what is not at its default. Keys ascend.
    nlohmann::json quality;
    int key_lights = 0;  ///< taken out of the probe
    math::SphericalWindow window = math::SphericalWindow::None;

    friend bool operator==(const Setting&, const Setting&) = default;
};

/// From "arc/bands=5/rank=8/key_lights=16/window=hann": a representation, then any of a material file's settings for
/// it, key_lights as a number, and window. What settings there are is not checked before cook(). Throws Error (input).
Setting parse_setting(const std::string& text);

/// Inverse of parse_setting: short, and different for different settings.
std::string setting_name(const Setting& setting);

nlohmann::json to_json(const Setting& setting);
/// Throws Error (input) naming `file` for what to_json() does not write.
Setting setting_from_json(const nlohmann::json& json, const std::string& file);

std::string representation_of(const Setting& setting);

/// Throws Error (input) if cook() would, without baking anything.
void check(nlohmann::json json, const std::string& file, const Setting& setting);

/// The material `json` of the file `file`, shaded as the setting says. Throws Error (input), also if the setting does
/// not suit the grating.
diffraction::CookedMaterial cook(nlohmann::json json, const std::string& file, const Setting& setting);

}  // namespace rowland::trade

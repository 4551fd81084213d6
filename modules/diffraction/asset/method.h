#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/math/sh_window.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::diffraction {

/// A way to shade a material and to divide its light, written "arc/bands=5/rank=8/key_lights=16/window=hann".
struct Method {
    /// A material file's "quality" but for key_lights: "representation" and the settings that are given. Keys ascend.
    nlohmann::json quality;
    int key_lights = 0;  ///< extracted from the probe and shaded one by one; default: 16 if required, else 0
    math::SphericalWindow window = math::SphericalWindow::None;

    friend bool operator==(const Method&, const Method&) = default;
};

/// Parses a representation, then any of its settings, key_lights and window, each once. Values must be within the
/// limits that material files have. Throws Error (input).
Method parse_method(const std::string& text);

/// Inverse of parse_method(): short, and different for different methods.
std::string method_name(const Method& method);

nlohmann::json to_json(const Method& method);
/// Throws Error (input) naming `file` for what to_json() does not write.
Method method_from_json(const nlohmann::json& json, const std::string& file);

const RepresentationInfo& info(const Method& method);

/// The material file `json` with the method in place of its "quality". Settings that the method does not give are the
/// file's where it pins the same representation, else the defaults.
nlohmann::json with_method(nlohmann::json json, const Method& method);

/// Why the method cannot shade a grating; nullopt if it can.
std::optional<Refusal> refusal(const Method& method, const Grating& grating);

/// Throws Error (input) if cook() would, without baking.
void check_method(const nlohmann::json& json, const std::string& file, const Method& method);

/// Bakes the material `json` of the file `file` as the method says. Throws Error (input), also if the method does not
/// suit the grating.
CookedMaterial cook(const nlohmann::json& json, const std::string& file, const Method& method);

}  // namespace rowland::diffraction

#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// Parses the material object of a .json file or of the glTF extension. Every failure is an Error (input) that names
/// `file`, the JSON pointer, what was found and what was expected; unknown keys name the nearest valid one.
Material parse_material(const nlohmann::json& json, const std::string& file);

/// Reads and parses a material file.
Material load_material(const std::filesystem::path& path);

}  // namespace rowland::diffraction

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// A file that a material names, and what messages call it.
struct NamedText {
    std::string text;
    std::string file;
};

/// Reads a file that a material names: "file" of a table or a height map, "illuminant" of its quality. Throws Error
/// (input) if it cannot.
using ReadNamed = std::function<NamedText(const std::string& name)>;

/// The largest file that a material may name.
inline constexpr std::uint64_t kMaximumNamedFileSize = 16 << 20;

/// Reads names relative to a folder.
ReadNamed read_beside(std::filesystem::path folder);

/// Parses the material object of a .json file or of the glTF extension. Every failure is an Error (input) that names
/// `file`, the JSON pointer, what was found and what was expected; unknown keys name the nearest valid one.
Material parse_material(const nlohmann::json& json, const std::string& file, const ReadNamed& read);

/// The same, where names are relative to the folder of `file`.
Material parse_material(const nlohmann::json& json, const std::string& file);

/// A material file's JSON, not checked yet. Throws Error (input).
nlohmann::json load_material_json(const std::filesystem::path& path);

/// Reads and parses a material file.
Material load_material(const std::filesystem::path& path);

}  // namespace rowland::diffraction

#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/bake/spike_table.h"

namespace rowland::diffraction {

inline constexpr const char* kMaterialAssetType = "material";
inline constexpr std::uint32_t kMaterialAssetVersion = 1;

/// A material with what was baked for it.
struct CookedMaterial {
    Material material;
    SpikeTable table;
};

/// Parses `json` and bakes its view table. Throws Error (input) naming `file`.
CookedMaterial cook_material(const nlohmann::json& json, const std::string& file);

/// The payload of a cooked material: the source as compact JSON, then the table.
std::vector<std::byte> write_cooked_material(const nlohmann::json& json, const CookedMaterial& cooked);

/// Inverse of write_cooked_material for bytes that may be hostile. Throws Error (input).
CookedMaterial read_cooked_material(std::span<const std::byte> payload, const std::string& file);

/// Loads a cooked material file. Throws Error (input); a wrong version names the command that recooks.
CookedMaterial load_cooked_material(const std::filesystem::path& path);

/// What a cooked material holds, a "name: value" line each.
std::string describe(const CookedMaterial& cooked);

}  // namespace rowland::diffraction

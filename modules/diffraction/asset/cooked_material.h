#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat3x3.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/asset/groove_pitches.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/asset/quality.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::diffraction {

inline constexpr const char* kMaterialAssetType = "material";
inline constexpr std::uint32_t kMaterialAssetVersion = 10;

struct CookedMaterial;

/// A cheaper choice for a material's grating, with a larger error: what a frame may draw instead.
struct CookedRung {
    nlohmann::json settings;  ///< members of the material's "quality"
    Quality quality;
    /// Holds only its tables and its other side. Rungs that differ in key lights alone share it. Null: the material's
    /// own tables.
    std::shared_ptr<const CookedMaterial> baked;
    BudgetRecord measured;
};

/// A material with its baked tables.
struct CookedMaterial {
    Material material;
    BakedTables tables;
    KernelTable kernel;                      ///< for analytic lights, key lights, and maps filled at run time
    glm::dmat3 zero_order_xyz{0.0};          ///< ColourKernel::zero_order_xyz()
    std::optional<BudgetRecord> measured{};  ///< errors of the representation; none if they were not measured
    std::shared_ptr<const CookedMaterial> reflected = nullptr;  ///< reflected_side(), with the same quality; null: none
    std::vector<CookedRung> cheaper{};                          ///< the cheapest first; none if nothing was measured
};

/// The largest number of rungs, the material itself included.
inline constexpr std::size_t kMostRungs = 6;

/// The material as one of its rungs, of `cooked.cheaper`, draws it; the result has no rungs.
CookedMaterial as_rung(const CookedMaterial& cooked, const CookedRung& rung);

/// The reflected_side() of a sheet, baked with the material's quality; null if the material has none.
std::shared_ptr<const CookedMaterial> bake_reflected_side(const Material& material);

/// Throws Error (input) naming `file` for fewer grooves than baked materials need (kManyGrooves).
void require_baked_grooves(const Grating& grating, const std::string& file);

/// The material with its kernel, without tables.
CookedMaterial bake_kernel(const Material& material);

/// Bakes the material's representation. Throws Error (input) if the grating does not suit it.
CookedMaterial bake_material(const Material& material);

/// Parses `json` and bakes the pinned representation. Ignores max_error: see choose_representation(). Named files are
/// read by `read`, or beside `file`. Throws Error (input) naming `file`.
CookedMaterial cook_material(const nlohmann::json& json, const std::string& file, const ReadNamed& read);
CookedMaterial cook_material(const nlohmann::json& json, const std::string& file);
/// cook_material() of with_method(). Throws Error (input), also if the method does not suit the grating.
CookedMaterial cook(const nlohmann::json& json, const std::string& file, const Method& method);
/// Throws Error (input) where cook() refuses the file or the method; neither solves nor bakes.
void check_method(const nlohmann::json& json, const std::string& file, const Method& method);

/// The files that a material names (efficiencies, heights, illuminant), by their names: texts written from the parsed
/// material, which parse to the same values.
using NamedTexts = std::map<std::string, std::string>;
NamedTexts named_texts(const nlohmann::json& json, const Material& material);

/// The payload of a cooked material: the source as compact JSON with the chosen representation pinned, the CSV files
/// that it names, the kernel, the representation's number and tables, those of a sheet's reflected side, the record of
/// its errors (empty text for none), and the cheaper rungs. It needs no other file.
std::vector<std::byte> write_cooked_material(const nlohmann::json& json, const CookedMaterial& cooked);

/// Inverse of write_cooked_material() for untrusted bytes. Throws Error (input) naming `file`.
CookedMaterial read_cooked_material(std::span<const std::byte> payload, const std::string& file);

/// The tables of a glTF material's grating: the smallest and largest pitch of its groove texture, then the payload of a
/// cooked material. read_gltf_tables() takes untrusted bytes and throws Error (input) naming `file`.
inline constexpr std::uint32_t kGltfTablesVersion = 1;
std::vector<std::byte> write_gltf_tables(const nlohmann::json& json, const CookedMaterial& cooked,
                                         const GroovePitches& pitches);
CookedMaterial read_gltf_tables(std::span<const std::byte> tables, const std::string& file);

/// Loads a cooked material file. Throws Error (input); a wrong version names the command that recooks.
CookedMaterial load_cooked_material(const std::filesystem::path& path);

/// The contents of a cooked material as "name: value" lines.
std::string describe(const CookedMaterial& cooked);

}  // namespace rowland::diffraction

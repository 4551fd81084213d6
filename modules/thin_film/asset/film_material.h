#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/colour/illuminant.h"
#include "engine/core/json_reader.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// A film material file: a film, the thicknesses and roughnesses that its surface has, and the light it is baked for.
struct FilmMaterial {
    Film film;         ///< its outermost layer has the thickness range.thickest_nm
    TableRange range;  ///< one thickness and one roughness, unless a texture varies them
    colour::Illuminant illuminant = colour::d65();
};

/// {"film": {"ior": 1.33, "thickness_nm": 400}, "base": {"ior": 1.5} or "metal": "Al", "roughness": 0}: the module's
/// README. Throws Error (input) that names `file` and the JSON pointer.
FilmMaterial parse_film_material(const nlohmann::json& json, const std::string& file, const std::string& pointer = "");
FilmMaterial parse_film_material(JsonReader& reader);

/// Reads "metal" or "base", exactly one of which the object must have. Throws Error (input).
Base parse_base(JsonReader& json);

inline constexpr NumberRange kFilmIndexRange{.minimum = 1.0, .maximum = 10.0};
inline constexpr NumberRange kThicknessRange_nm{.minimum = 0.0, .maximum = 1e5};

/// Bakes the table, in a size for the range. Throws nothing for what parse_film_material() gives.
FilmTable bake_film(const FilmMaterial& material);

inline constexpr const char* kFilmAssetType = "film";
inline constexpr std::uint32_t kFilmAssetVersion = 2;

struct CookedFilm {
    FilmMaterial material;
    FilmTable table;
};

/// Parses and bakes. Throws Error (input) naming `file`.
CookedFilm cook_film(const nlohmann::json& json, const std::string& file);

/// The payload of a cooked film: the source as compact JSON, and the table with its error.
std::vector<std::byte> write_cooked_film(const nlohmann::json& json, const CookedFilm& cooked);

/// Inverse of write_cooked_film for untrusted bytes. Throws Error (input).
CookedFilm read_cooked_film(std::span<const std::byte> payload, const std::string& file);

inline constexpr std::uint32_t kGltfFilmVersion = 1;

/// The payload of a glTF material's film: its table and range, without the base.
std::vector<std::byte> write_gltf_film(const FilmMaterial& material, const FilmTable& table);

/// Inverse of write_gltf_film for untrusted bytes. Throws Error (input).
FilmTable read_gltf_film(std::span<const std::byte> tables, const std::string& file);

/// The table as "name: value" lines.
std::string describe(const FilmTable& table);

/// Loads a cooked film file. Throws Error (input); a wrong version names the command that recooks.
CookedFilm load_cooked_film(const std::filesystem::path& path);

/// The contents as "name: value" lines.
std::string describe(const CookedFilm& cooked);

}  // namespace rowland::thin_film

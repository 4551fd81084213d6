#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "engine/colour/illuminant.h"
#include "engine/core/json_reader.h"
#include "modules/thin_film/bake/film_table.h"
#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// A film material file: a film, the thicknesses and roughnesses that its surface has, and the light it is baked for.
struct FilmMaterial {
    Film film;         ///< its outermost layer is as thick as the thickest
    TableRange range;  ///< one thickness and one roughness, unless a texture varies them
    colour::Illuminant illuminant = colour::d65();
};

/// {"film": {"ior": 1.33, "thickness_nm": 400}, "base": {"ior": 1.5} or "metal": "Al", "roughness": 0}: the module's
/// README. Throws Error (input) that names `file` and the JSON pointer.
FilmMaterial parse_film_material(const nlohmann::json& json, const std::string& file, const std::string& pointer = "");

/// "metal", or "base" with its index, of an object that has one of them. Throws Error (input).
Base parse_base(JsonReader& json);

inline constexpr NumberRange kFilmIndex{.minimum = 1.0, .maximum = 10.0};
inline constexpr NumberRange kThickness_nm{.minimum = 0.0, .maximum = 1e5};

/// Bakes the table, in a size for the range. Throws nothing for what parse_film_material() gives.
FilmTable bake_film(const FilmMaterial& material);

}  // namespace rowland::thin_film

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "modules/thin_film/asset/film_material.h"

namespace rowland::thin_film {

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

/// Loads a cooked film file. Throws Error (input); a wrong version names the command that recooks.
CookedFilm load_cooked_film(const std::filesystem::path& path);

/// The contents as "name: value" lines.
std::string describe(const CookedFilm& cooked);

}  // namespace rowland::thin_film

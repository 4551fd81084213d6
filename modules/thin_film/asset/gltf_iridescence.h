#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "engine/colour/illuminant.h"
#include "engine/scene/imported_scene.h"
#include "modules/thin_film/asset/film_material.h"
#include "modules/thin_film/model/film.h"

namespace rowland::thin_film {

/// Khronos' glTF material extension for thin films.
inline constexpr const char* kIridescenceExtension = "KHR_materials_iridescence";
/// Khronos' glTF material extension for the index of refraction of a dielectric, here the base under a film.
inline constexpr const char* kIorExtension = "KHR_materials_ior";

/// A material's KHR_materials_iridescence object.
struct GltfIridescence {
    double factor = 0.0;
    std::optional<scene::TextureUse> factor_texture;  ///< R
    double ior = 1.3;
    double minimum_thickness_nm = 100.0;  ///< where the thickness texture is 0
    double maximum_thickness_nm = 400.0;  ///< where it is 1, and everywhere without one; may be the smaller
    std::optional<scene::TextureUse> thickness_texture;  ///< G
    std::optional<Base> base;                       ///< "metal" or "base" of its extras, as in a film material file
    colour::Illuminant illuminant = colour::d65();  ///< of its extras
};

/// Parses the extension's object. Other extras and extensions are ignored. Throws Error (input).
GltfIridescence parse_gltf_iridescence(const nlohmann::json& json, const std::string& file, const std::string& pointer);

/// The index of a KHR_materials_ior object; 1.5 by default. For 0, by which the extension means an infinite index, it
/// is 1e6. Throws Error (input).
double parse_gltf_ior(const nlohmann::json& json, const std::string& file, const std::string& pointer);

/// A film material file's object as a glTF holds it: KHR_materials_iridescence, with the exact base and the illuminant
/// in its extras. "roughness" is left out: the glTF material has it. A thickness texture, if one is added, varies the
/// thickness from 0 to the film's. `material` must have passed parse_film_material(). Throws Error (input) naming
/// `file` for what the extension cannot hold: several layers, or one that absorbs.
nlohmann::ordered_json gltf_object(const nlohmann::ordered_json& material, const std::string& file);

/// "100 to 400 nm of ior 1.3, factor 1"
std::string describe(const GltfIridescence& iridescence);

/// The film of a material with this extension, whose object's JSON pointer is `pointer`; nullopt if it is not drawn:
/// factor 0, or unlit. The base, thicknesses and roughnesses: PHYSICS §3. Throws Error (input).
std::optional<FilmMaterial> film_material(const GltfIridescence& iridescence,
                                          const scene::MaterialDescription& description, const std::string& file,
                                          const std::string& pointer);

}  // namespace rowland::thin_film

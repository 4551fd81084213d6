#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// The glTF material extension that holds a grating.
inline constexpr const char* kGltfExtension = "ROWLAND_materials_diffraction";

/// A texture that varies the grating over the surface, as a glTF textureInfo names it. Linear; R: rotation / π,
/// G: pitch / pitch_nm / 2, 0 where there is no grating.
struct GrooveTexture {
    int index = 0;      ///< into the glTF's textures, ≥ 0
    int tex_coord = 0;  ///< set of texture coordinates, ≥ 0; KHR_texture_transform's, if it has one
    /// KHR_texture_transform: uv' = offset + rotate(rotation) · (scale · uv); rotation in radians.
    glm::dvec2 offset{0.0};
    double rotation = 0.0;
    glm::dvec2 scale{1.0};
    bool sparkle = false;  ///< "sparkle": facets of random directions; a pixel that covers many shows sixteen of them
};

/// How a grating lies on a surface.
struct GroovePlacement {
    bool has_base = false;         ///< false: the base layer is the glTF's metallic-roughness surface
    double groove_rotation = 0.0;  ///< radians by which g is rotated from the tangent toward the bitangent
    std::optional<GrooveTexture> groove_texture;
};

/// A material's ROWLAND_materials_diffraction object.
struct GltfGrating : GroovePlacement {
    Material material;
};

/// Parses the extension's object: a material object with the optional members "grooveRotation" and "grooveTexture";
/// "extras" and "extensions" are ignored, as glTF asks. A table's file name is relative to `folder`, that of the glTF.
/// `pointer` is the object's JSON pointer in `file`. Throws Error (input) as parse_material() does.
GltfGrating parse_gltf_extension(const nlohmann::json& json, const std::string& file,
                                 const std::filesystem::path& folder, const std::string& pointer = "");
/// The same, where files that the material names are read by `read`.
GltfGrating parse_gltf_extension(const nlohmann::json& json, const std::string& file, const ReadNamed& read,
                                 const std::string& pointer);
GltfGrating parse_gltf_extension(JsonReader& reader, const ReadNamed& read);

/// A material file's object as a glTF in `folder` holds it, as the value of kGltfExtension. "base" is left out: the
/// layer under the grating is the glTF material's own surface, with its textures. Names of files, relative to the
/// material file's folder `from`, become relative to `folder`. `material` must be valid (parse_material()). Throws
/// Error (input) for a name that is not UTF-8.
nlohmann::ordered_json gltf_object(nlohmann::ordered_json material, const std::filesystem::path& from,
                                   const std::filesystem::path& folder);

/// Rewrites the names of files in a material's object, which are relative to the folder `from`, to be relative to `to`.
/// Members of another type than parse_material() expects stay as they are. Throws Error (input) for a name that is not
/// UTF-8.
void move_named_files(nlohmann::ordered_json& object, const std::filesystem::path& from,
                      const std::filesystem::path& to);

/// "740 nm lamellar, grooves turned by 30 degrees, groove texture 2"
std::string describe(const GltfGrating& grating);

/// Parses the placement alone and ignores the other members. Throws Error (input).
GroovePlacement parse_groove_placement(const nlohmann::json& json, const std::string& file, const std::string& pointer);

/// The extension's object without the members that a material file cannot have.
nlohmann::json material_members(nlohmann::json object);

}  // namespace rowland::diffraction

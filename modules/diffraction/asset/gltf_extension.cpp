#include "modules/diffraction/asset/gltf_extension.h"

#include <limits>

#include "engine/core/json_reader.h"
#include "engine/core/json_vector.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/asset/material_parts.h"

namespace rowland::diffraction {

namespace {

/// glTF allows both members on every object, with any content.
void allow_foreign_members(JsonReader& json) {
    json.has("extras");
    json.has("extensions");
}

constexpr std::int64_t kLargestIndex = std::numeric_limits<std::int32_t>::max();

void parse_transform(JsonReader json, GrooveTexture& texture) {
    texture.offset = read_vector_or(json, "offset", texture.offset, kFiniteFloat);
    texture.scale = read_vector_or(json, "scale", texture.scale, kFiniteFloat);
    texture.rotation = json.number_or("rotation", texture.rotation, kFiniteFloat);
    texture.tex_coord = static_cast<int>(json.integer_or("texCoord", texture.tex_coord, 0, kLargestIndex));
    allow_foreign_members(json);
    json.finish();
}

GrooveTexture parse_groove_texture(JsonReader json) {
    GrooveTexture texture{.index = static_cast<int>(json.integer("index", 0, kLargestIndex)),
                          .tex_coord = static_cast<int>(json.integer_or("texCoord", 0, 0, kLargestIndex))};
    texture.sparkle = json.boolean_or("sparkle", false);
    if (auto extensions = json.object_if_there("extensions"))
        if (auto transform = extensions->object_if_there("KHR_texture_transform")) parse_transform(*transform, texture);
    allow_foreign_members(json);
    json.finish();
    return texture;
}

}  // namespace

GltfGrating parse_gltf_extension(const nlohmann::json& json, const std::string& file,
                                 const std::filesystem::path& folder, const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    GltfGrating result;
    result.material = parse_material_parts(reader, read_beside(folder));
    result.has_base = reader.has("base");
    result.groove_rotation = reader.number_or("grooveRotation", 0.0, {});
    if (auto texture = reader.object_if_there("grooveTexture")) result.groove_texture = parse_groove_texture(*texture);
    if (result.groove_texture && result.material.grating.lattice)
        reader.fail("grooveTexture", "a groove texture on a lattice", "no grooveTexture",
                    "it varies grooves of one direction");
    allow_foreign_members(reader);
    reader.finish();
    return result;
}

}  // namespace rowland::diffraction

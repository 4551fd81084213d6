#include "modules/diffraction/asset/gltf_extension.h"

#include <limits>

namespace rowland::diffraction {

namespace {

/// glTF allows both members on every object, with any content.
void allow_foreign_members(JsonReader& json) {
    json.ignore("extras");
    json.ignore("extensions");
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

void read_placement(JsonReader& reader, GroovePlacement& placement) {
    placement.has_base = reader.has("base");
    placement.groove_rotation = reader.number_or("grooveRotation", 0.0, {});
    if (auto texture = reader.object_if_there("grooveTexture"))
        placement.groove_texture = parse_groove_texture(*texture);
}

}  // namespace

GltfGrating parse_gltf_extension(const nlohmann::json& json, const std::string& file, const ReadNamed& read,
                                 const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    return parse_gltf_extension(reader, read);
}

GltfGrating parse_gltf_extension(JsonReader& reader, const ReadNamed& read) {
    GltfGrating result;
    result.material = parse_material(reader, read);
    read_placement(reader, result);
    if (result.groove_texture && result.material.grating.lattice)
        reader.fail("grooveTexture", "a groove texture on a lattice", "no grooveTexture",
                    "it varies grooves of one direction");
    allow_foreign_members(reader);
    reader.finish();
    return result;
}

GltfGrating parse_gltf_extension(const nlohmann::json& json, const std::string& file,
                                 const std::filesystem::path& folder, const std::string& pointer) {
    return parse_gltf_extension(json, file, read_beside(folder), pointer);
}

GroovePlacement parse_groove_placement(const nlohmann::json& json, const std::string& file,
                                       const std::string& pointer) {
    JsonReader reader(json, file, pointer);
    GroovePlacement placement;
    read_placement(reader, placement);
    return placement;
}

}  // namespace rowland::diffraction

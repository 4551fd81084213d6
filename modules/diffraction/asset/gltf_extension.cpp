#include "modules/diffraction/asset/gltf_extension.h"

#include <limits>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/asset/material_parts.h"

namespace rowland::diffraction {

namespace {

/// glTF allows both on any object, and a reader passes over those it does not know.
void pass_over_foreign_members(JsonReader& json) {
    json.has("extras");
    json.has("extensions");
}

GrooveTexture parse_groove_texture(JsonReader json) {
    constexpr std::int64_t largest = std::numeric_limits<std::int32_t>::max();
    const GrooveTexture texture{.index = static_cast<int>(json.integer("index", 0, largest)),
                                .tex_coord = static_cast<int>(json.integer_or("texCoord", 0, 0, largest))};
    pass_over_foreign_members(json);
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
    if (reader.has("grooveTexture")) result.groove_texture = parse_groove_texture(reader.object("grooveTexture"));
    pass_over_foreign_members(reader);
    reader.finish();
    return result;
}

}  // namespace rowland::diffraction

#include "modules/diffraction/asset/gltf_extension.h"

#include <limits>
#include <vector>

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

constexpr std::int64_t kLargestIndex = std::numeric_limits<std::int32_t>::max();

void parse_transform(JsonReader json, GrooveTexture& texture) {
    const auto pair = [&](const char* key, glm::dvec2& value) {
        if (!json.has(key)) return;
        const std::vector<double> numbers = json.numbers(key, 2, kFiniteFloat);
        value = {numbers[0], numbers[1]};
    };
    pair("offset", texture.offset);
    pair("scale", texture.scale);
    texture.rotation = json.number_or("rotation", texture.rotation, kFiniteFloat);
    texture.tex_coord = static_cast<int>(json.integer_or("texCoord", texture.tex_coord, 0, kLargestIndex));
    pass_over_foreign_members(json);
    json.finish();
}

GrooveTexture parse_groove_texture(JsonReader json) {
    GrooveTexture texture{.index = static_cast<int>(json.integer("index", 0, kLargestIndex)),
                          .tex_coord = static_cast<int>(json.integer_or("texCoord", 0, 0, kLargestIndex))};
    if (json.has("extensions")) {
        JsonReader extensions = json.object("extensions");
        if (extensions.has("KHR_texture_transform"))
            parse_transform(extensions.object("KHR_texture_transform"), texture);
    }
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

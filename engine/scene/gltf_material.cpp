#include <fmt/format.h>

#include <algorithm>
#include <glm/common.hpp>
#include <limits>

#include "engine/scene/gltf_parts.h"

namespace rowland::scene {

namespace {

// Exporters round: what is a little over 1 is clamped.
constexpr NumberRange kFactor{.minimum = 0.0, .maximum = 1.001};
// Far above any real light; the product of two stays finite.
constexpr NumberRange kEmission{.minimum = 0.0, .maximum = 1e6};
constexpr NumberRange kNotNegative{.minimum = 0.0, .maximum = std::numeric_limits<float>::max()};

float factor_or(JsonReader& reader, const std::string& key, double fallback) {
    return static_cast<float>(std::min(reader.number_or(key, fallback, kFactor), 1.0));
}

float factor_or_one(JsonReader& reader, const std::string& key) {
    return factor_or(reader, key, 1.0);
}

struct MaterialReading {
    const GltfJson& json;
    std::span<const GltfTexture> textures;
    JsonReader& material;
    MaterialDescription to = {};

    std::optional<TextureUse> texture(JsonReader& owner, const std::string& key) const {
        return read_texture_use(json, owner, key, textures);
    }

    void read_metallic_roughness() {
        if (!material.has("pbrMetallicRoughness")) return;
        JsonReader pbr = material.object("pbrMetallicRoughness");
        to.base_colour = glm::min(read_vector_or(pbr, "baseColorFactor", glm::vec4(1.0F), kFactor), glm::vec4(1.0F));
        to.metallic = factor_or_one(pbr, "metallicFactor");
        to.roughness = factor_or_one(pbr, "roughnessFactor");
        to.base_colour_texture = texture(pbr, "baseColorTexture");
        to.metallic_roughness_texture = texture(pbr, "metallicRoughnessTexture");
    }

    void read_maps() {
        to.normal_texture = texture(material, "normalTexture");
        if (auto normal = material.object_if_there("normalTexture"))
            to.normal_scale = static_cast<float>(normal->number_or("scale", 1.0, kFiniteFloat));
        to.occlusion_texture = texture(material, "occlusionTexture");
        if (auto occlusion = material.object_if_there("occlusionTexture"))
            to.occlusion_strength = factor_or_one(*occlusion, "strength");
        to.emissive_texture = texture(material, "emissiveTexture");
        to.emissive = read_vector_or(material, "emissiveFactor", glm::vec3(0.0F), kEmission);
    }

    void read_alpha() {
        if (material.has("alphaMode"))
            to.alpha_mode = material.choice<AlphaMode>(
                "alphaMode", {{"OPAQUE", AlphaMode::Opaque}, {"MASK", AlphaMode::Mask}, {"BLEND", AlphaMode::Blend}});
        to.alpha_cutoff = static_cast<float>(material.number_or("alphaCutoff", 0.5, kNotNegative));
        to.double_sided = material.boolean_or("doubleSided", false);
    }

    void read_clear_coat(JsonReader coat) {
        to.clear_coat = factor_or(coat, "clearcoatFactor", 0.0);
        to.clear_coat_roughness = factor_or(coat, "clearcoatRoughnessFactor", 0.0);
        for (const char* map : {"clearcoatTexture", "clearcoatRoughnessTexture", "clearcoatNormalTexture"})
            if (coat.has(map)) json.warn(fmt::format("a material's {} is not read: its clear coat is even", map));
    }

    void read_extensions() {
        if (!material.has("extensions")) return;
        JsonReader extensions = material.object("extensions");
        for (const auto& [name, value] : material.raw("extensions").items()) {
            if (name == "KHR_materials_unlit") {
                extensions.object(name);
                to.unlit = true;
            } else if (name == "KHR_materials_emissive_strength") {
                to.emissive *=
                    static_cast<float>(extensions.object(name).number_or("emissiveStrength", 1.0, kEmission));
            } else if (name == "KHR_materials_clearcoat") {
                read_clear_coat(extensions.object(name));
            } else {
                to.extensions[name] = value;
            }
        }
    }
};

}  // namespace

std::vector<MaterialDescription> read_materials(const GltfJson& json, std::span<const GltfTexture> textures) {
    std::vector<MaterialDescription> materials;
    for (JsonReader& material : json.objects("materials")) {
        MaterialReading reading{json, textures, material};
        reading.to.name = material.text_or("name", "");
        reading.read_metallic_roughness();
        reading.read_maps();
        reading.read_alpha();
        reading.read_extensions();
        materials.push_back(std::move(reading.to));
    }
    return materials;
}

}  // namespace rowland::scene

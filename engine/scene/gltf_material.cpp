#include "engine/scene/gltf_material.h"

#include <algorithm>
#include <limits>

#include "engine/core/json_reader.h"
#include "engine/scene/gltf_index.h"
#include "engine/scene/gltf_texture.h"

namespace rowland::scene {

namespace {

// Exporters round: what is a little over 1 is clamped.
constexpr NumberRange kFactor{.minimum = 0.0, .maximum = 1.001};
// Far above anything that is lit, and their product is finite.
constexpr NumberRange kEmission{.minimum = 0.0, .maximum = 1e6};
constexpr NumberRange kNotNegative{.minimum = 0.0, .maximum = std::numeric_limits<float>::max()};

float share(double x) {
    return static_cast<float>(std::clamp(x, 0.0, 1.0));
}

/// One material of `json`.
struct Reading {
    const nlohmann::json& json;
    std::span<const GltfTexture> textures;
    std::vector<std::string>& warnings;
    JsonReader& material;
    MaterialDescription to;

    std::optional<TextureUse> texture(JsonReader& owner, const std::string& key) const {
        return read_texture_use(json, owner, key, textures, warnings);
    }

    void read_metallic_roughness() {
        if (!material.has("pbrMetallicRoughness")) return;
        JsonReader pbr = material.object("pbrMetallicRoughness");
        if (pbr.has("baseColorFactor")) {
            const std::vector<double> colour = pbr.numbers("baseColorFactor", 4, kFactor);
            to.base_colour = {share(colour[0]), share(colour[1]), share(colour[2]), share(colour[3])};
        }
        to.metallic = share(pbr.number_or("metallicFactor", 1.0, kFactor));
        to.roughness = share(pbr.number_or("roughnessFactor", 1.0, kFactor));
        to.base_colour_texture = texture(pbr, "baseColorTexture");
        to.metallic_roughness_texture = texture(pbr, "metallicRoughnessTexture");
    }

    void read_maps() {
        to.normal_texture = texture(material, "normalTexture");
        if (material.has("normalTexture"))
            to.normal_scale =
                static_cast<float>(material.object("normalTexture").number_or("scale", 1.0, kFiniteFloat));
        to.occlusion_texture = texture(material, "occlusionTexture");
        if (material.has("occlusionTexture"))
            to.occlusion_strength = share(material.object("occlusionTexture").number_or("strength", 1.0, kFactor));
    }

    void read_emission() {
        to.emissive_texture = texture(material, "emissiveTexture");
        if (!material.has("emissiveFactor")) return;
        const std::vector<double> emissive = material.numbers("emissiveFactor", 3, kEmission);
        to.emissive = {emissive[0], emissive[1], emissive[2]};
    }

    void read_alpha() {
        const std::string mode = material.choice_or("alphaMode", "OPAQUE", {"OPAQUE", "MASK", "BLEND"});
        to.alpha_mode = mode == "MASK" ? AlphaMode::Mask : mode == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
        to.alpha_cutoff = static_cast<float>(material.number_or("alphaCutoff", 0.5, kNotNegative));
        to.double_sided = material.boolean_or("doubleSided", false);
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
            } else {
                to.extensions[name] = value;
            }
        }
    }
};

}  // namespace

std::vector<MaterialDescription> read_materials(const nlohmann::json& json, const std::string& file,
                                                std::span<const GltfTexture> textures,
                                                std::vector<std::string>& warnings) {
    std::vector<MaterialDescription> materials;
    for (JsonReader& material : root_objects(json, file, "materials")) {
        Reading reading{json, textures, warnings, material, {}};
        reading.to.name = text_if_there(material, "name");
        reading.read_metallic_roughness();
        reading.read_maps();
        reading.read_emission();
        reading.read_alpha();
        reading.read_extensions();
        materials.push_back(std::move(reading.to));
    }
    return materials;
}

}  // namespace rowland::scene

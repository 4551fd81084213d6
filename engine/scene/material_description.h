#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace rowland::scene {

/// KHR_texture_transform: uv' = offset + rotate(rotation) · (scale · uv).
struct TextureTransform {
    glm::vec2 offset{0.0F};
    float rotation = 0.0F;  ///< radians, as the extension turns it
    glm::vec2 scale{1.0F};
};

struct TextureUse {
    std::size_t texture = 0;  ///< into ImportedScene::textures
    int uv_set = 0;           ///< 0 or 1
    TextureTransform transform;
};

enum class AlphaMode {
    Opaque,
    Mask,   ///< drawn where alpha ≥ the cutoff
    Blend,  ///< drawn over what is behind
};

/// glTF metallic-roughness material. Factors are linear; textures multiply them. Other material
/// extensions are kept as JSON for their registered handlers.
struct MaterialDescription {
    std::string name;
    glm::vec4 base_colour{1.0F};
    float metallic = 1.0F;
    float roughness = 1.0F;
    glm::vec3 emissive{0.0F};
    std::optional<TextureUse> base_colour_texture;         ///< sRGB, alpha linear
    std::optional<TextureUse> metallic_roughness_texture;  ///< G: roughness, B: metallic
    std::optional<TextureUse> normal_texture;
    float normal_scale = 1.0F;
    std::optional<TextureUse> occlusion_texture;  ///< R
    float occlusion_strength = 1.0F;
    std::optional<TextureUse> emissive_texture;  ///< sRGB
    AlphaMode alpha_mode = AlphaMode::Opaque;
    float alpha_cutoff = 0.5F;
    bool double_sided = false;
    bool unlit = false;                 ///< KHR_materials_unlit
    float clear_coat = 0.0F;            ///< KHR_materials_clearcoat: its factor, without textures
    float clear_coat_roughness = 0.0F;  ///< perceptual, likewise
    std::map<std::string, nlohmann::json> extensions;
};

}  // namespace rowland::scene

#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/image/byte_image.h"
#include "engine/scene/animation.h"
#include "engine/scene/light.h"
#include "engine/scene/mesh.h"
#include "engine/scene/transform.h"
#include "engine/scene/wear.h"

namespace rowland::scene {

/// KHR_texture_transform: uv' = offset + rotate(rotation) · (scale · uv).
struct TextureTransform {
    glm::vec2 offset{0.0F};
    float rotation = 0.0F;  ///< radians, in the extension's sense of rotation
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
    bool unlit = false;                      ///< KHR_materials_unlit
    float clear_coat = 0.0F;                 ///< KHR_materials_clearcoat: its factor, without textures
    float clear_coat_roughness = 0.0F;       ///< perceptual; its factor, without textures
    std::optional<Wear> wear;                ///< ROWLAND_materials_wear
    std::optional<std::size_t> wear_mask;    ///< texture whose red channel multiplies the wear
    std::optional<TextureUse> wear_texture;  ///< wear_map(), which the import adds to the textures
    std::map<std::string, nlohmann::json> extensions;
    /// Cooked scenes only: what GltfExtension::cook baked, by the extension's name; equal tables are shared.
    std::map<std::string, std::shared_ptr<const std::vector<std::byte>>> tables;
};

enum class TextureWrap { Repeat, Clamp, Mirror };

struct ImportedTexture {
    std::size_t image = 0;
    TextureWrap wrap_s = TextureWrap::Repeat;
    TextureWrap wrap_t = TextureWrap::Repeat;
    bool nearest = false;  ///< not filtered
    bool mipmaps = true;
};

/// A node of the scene to show.
struct ImportedNode {
    std::string name;
    std::optional<std::size_t> parent;  ///< an earlier node
    Transform local;                    ///< at rest
    glm::mat4 world{1.0F};              ///< at rest, exact even where `local` cannot hold a matrix's shear
    nlohmann::json extras;              ///< as written, at most 64 KiB of text; null: none
};

/// A mesh at a node. A skinned one is placed by its joints, not by its node.
struct ImportedInstance {
    std::string name;
    glm::mat4 transform{1.0F};  ///< the node's, at rest
    std::size_t mesh = 0;
    std::optional<std::size_t> material;
    std::size_t node = 0;
    std::optional<std::size_t> skin;
};

struct ImportedSkin {
    std::vector<std::size_t> joints;  ///< nodes
    std::vector<glm::mat4> inverse_bind;
};

/// KHR_lights_punctual; shines along its node's −Z. Lux are taken as irradiance, candela as irradiance at 1 m.
/// Its node's extras state what glTF lacks: `"casts_shadow": true` and `"light_angle"`, the diameter in degrees, of a
/// directional light; `"light_radius"`, in metres, of the others. Without them it is as large as the sun or a bulb.
struct ImportedLight {
    std::size_t node = 0;
    std::variant<DirectionalLight, PunctualLight> light;
};

/// A perspective camera that looks along its node's −Z, +Y up.
struct ImportedCamera {
    std::string name;
    std::size_t node = 0;
    float vertical_field_of_view = 0.7F;  ///< radians, 0 < it < π
    float near_plane = 0.01F;             ///< metres, > 0
    std::optional<float> far_plane;       ///< metres, > near_plane; none: at infinity
};

/// ROWLAND_light_probe: the light in a box about a node.
struct ImportedProbe {
    std::size_t node = 0;
    glm::vec3 size_m{1.0F};                     ///< of the box along the node's axes, to be multiplied by its scale
    float fade_m = 1.0F;                        ///< distance beyond the box over which its light fades to other light
    std::filesystem::path file;                 ///< the cooked probe, relative to the glTF's folder
    std::optional<std::size_t> gltf_node = {};  ///< the node's index in the glTF file; not in cooked scenes
    /// Cooked scenes only: the probe's payload; equal probes are shared. Null: the file was missing.
    std::shared_ptr<const std::vector<std::byte>> cooked = {};
};

/// How the tangents of a mesh were made.
enum class TangentSource {
    File,      ///< they are the file's
    Uvs,       ///< the direction in which u grows
    Arbitrary  ///< there are no texture coordinates either: any direction in the surface
};

/// A primitive's position in a glTF file.
struct PrimitiveId {
    std::size_t mesh = 0;
    std::size_t primitive = 0;  ///< of that mesh

    friend bool operator==(const PrimitiveId&, const PrimitiveId&) = default;
};

/// The contents of a glTF file that we draw.
struct ImportedScene {
    std::vector<Mesh> meshes;             ///< one per triangle primitive
    std::vector<PrimitiveId> primitives;  ///< of each mesh
    std::vector<MaterialDescription> materials;
    std::vector<ImportedInstance> instances;
    std::vector<std::string> warnings;  ///< what was ignored or repaired, without repetition
    std::vector<ImportedNode> nodes;    ///< parents before their children
    std::vector<std::shared_ptr<const image::ByteImage>> images;
    std::vector<ImportedTexture> textures;
    std::vector<ImportedSkin> skins;
    std::vector<Animation> animations;
    std::vector<ImportedLight> lights;
    std::vector<ImportedProbe> probes;    ///< in the order of the nodes
    std::vector<ImportedCamera> cameras;  ///< one per node with a camera, in the order of the nodes
    std::vector<TangentSource> tangents;  ///< one per mesh
};

/// Throws Error (input) at `pointer`/index unless the scene has a texture of this index, as an extension's texture
/// info names one.
void require_texture(const ImportedScene& scene, std::size_t index, const std::string& file,
                     const std::string& pointer);

}  // namespace rowland::scene

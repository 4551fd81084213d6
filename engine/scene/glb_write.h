#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/directional_light.h"
#include "engine/scene/draco_encode.h"
#include "engine/scene/mesh.h"
#include "engine/scene/punctual_light.h"
#include "engine/scene/transform.h"

namespace rowland::scene {

/// A picture that is filtered trilinearly.
struct GlbTexture {
    std::string name;
    std::vector<std::byte> png;
    bool clamp_x = false;  ///< or it repeats
    bool clamp_y = false;
};

struct GlbMaterial {
    struct ColourTexture {
        std::size_t texture = 0;
        glm::dvec2 repeat{1.0};  ///< factor on the uvs
    };

    std::string name;
    glm::dvec4 colour{1.0};  ///< linear, with alpha, each 0 … 1
    double metallic = 0.0;
    double roughness = 0.5;
    glm::dvec3 emission{0.0};                     ///< linear, each 0 … 1
    std::optional<ColourTexture> colour_texture;  ///< multiplies the colour
    bool blend = false;                           ///< over what is behind, by alpha
    bool double_sided = false;
    nlohmann::json extensions = nlohmann::json::object();  ///< by name, as they are
};

struct GlbPrimitive {
    Mesh mesh;  ///< positions, normals, tangents and uvs; nothing else is written
    std::optional<std::size_t> material;
};

struct GlbMesh {
    std::string name;
    std::vector<GlbPrimitive> primitives;
};

/// Looks along its node's −Z.
struct GlbCamera {
    std::string name;
    double vertical_field_of_view = 0.7;  ///< radians
    double near_plane = 0.01;
    double far_plane = 100.0;
};

/// Shines along its node's −Z; a directional light's own direction and shadow are not written.
struct GlbLight {
    std::string name;
    std::variant<DirectionalLight, PunctualLight> light;
};

struct GlbNode {
    std::string name;
    std::optional<std::size_t> parent;  ///< an earlier node
    Transform local;
    std::optional<std::size_t> mesh;
    std::optional<std::size_t> camera;
    std::optional<std::size_t> light;
    nlohmann::json extras;  ///< null: none
};

/// A scene to write. Elements refer to each other by index; the file keeps their order.
struct GlbScene {
    std::vector<GlbTexture> textures;
    std::vector<GlbMaterial> materials;
    std::vector<GlbMesh> meshes;
    std::vector<GlbCamera> cameras;
    std::vector<GlbLight> lights;
    std::vector<GlbNode> nodes;
};

/// A binary glTF 2.0 file whose meshes are Draco-compressed (KHR_draco_mesh_compression is required to read it); other
/// extensions are listed as used, not as required. The same scene gives the same bytes. Throws Error (system) if Draco
/// fails.
std::vector<std::byte> write_glb(const GlbScene& scene, const DracoBits& bits = {});

/// The same for one mesh at one node, both called `name`.
std::vector<std::byte> write_glb(const Mesh& mesh, const std::string& name = "mesh", const DracoBits& bits = {});

}  // namespace rowland::scene

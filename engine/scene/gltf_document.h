#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "engine/scene/imported_scene.h"

namespace rowland::scene {

inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

/// glTF's component types, with glTF's numbers.
enum class ComponentType : std::uint16_t {
    Int8 = 5120,
    Uint8 = 5121,
    Int16 = 5122,
    Uint16 = 5123,
    Uint32 = 5125,
    Float = 5126,
};

/// The primitive modes that we draw, with glTF's numbers; 0 to 3 are points and lines.
enum class PrimitiveMode : std::uint8_t { Triangles = 4, TriangleStrip = 5, TriangleFan = 6 };

/// Owned unless it is the GLB's binary chunk.
struct GltfBuffer {
    std::vector<std::byte> owned;
    std::span<const std::byte> bytes;
};

struct GltfBufferView {
    std::size_t buffer = 0;
    std::size_t offset = 0;
    std::size_t length = 0;
    std::size_t stride = 0;  ///< 0: tightly packed
};

/// Elements that replace some of an accessor's.
struct GltfSparse {
    std::size_t count = 0;
    std::size_t index_view = 0;
    std::size_t index_offset = 0;
    ComponentType index_type = ComponentType::Uint32;
    std::size_t value_view = 0;
    std::size_t value_offset = 0;
};

struct GltfAccessor {
    std::optional<std::size_t> view;  ///< nullopt: zeros, unless a Draco stream holds the data
    std::size_t offset = 0;
    std::size_t count = 0;
    ComponentType type = ComponentType::Float;
    int rows = 1;     ///< components of a column
    int columns = 1;  ///< more than 1 for matrices
    bool normalised = false;
    std::optional<GltfSparse> sparse;
};

struct GltfDraco {
    std::size_t view = 0;
    std::map<std::string, std::uint32_t> attributes;  ///< glTF attribute name → Draco's unique id
};

struct GltfPrimitive {
    std::map<std::string, std::size_t> attributes;  ///< name → accessor
    std::optional<std::size_t> indices;
    std::optional<std::size_t> material;
    PrimitiveMode mode = PrimitiveMode::Triangles;
    std::optional<GltfDraco> draco;
};

struct GltfMesh {
    std::string name;
    std::vector<GltfPrimitive> primitives;
};

struct GltfNode {
    std::string name;
    glm::dmat4 local{1.0};
    Transform rest;  ///< `local` decomposed, without the shear that a matrix may hold
    std::vector<std::size_t> children;
    std::optional<std::size_t> mesh;
    std::optional<std::size_t> skin;
    std::optional<std::size_t> light;
    std::optional<std::size_t> camera;
    nlohmann::json extras;         ///< null: none
    std::size_t extras_bytes = 0;  ///< as text
};

struct GltfImage {
    std::optional<std::size_t> view;
    std::string uri;  ///< where the bytes are if there is no view
};

struct GltfTexture {
    std::optional<std::size_t> image;  ///< nullopt: only an unknown extension names one
    ImportedTexture settings;          ///< its image is not set
};

struct GltfSkin {
    std::vector<std::size_t> joints;
    std::optional<std::size_t> inverse_bind;  ///< accessor; nullopt: identities
};

using GltfLight = std::variant<DirectionalLight, PunctualLight>;

/// A parsed glTF file. All indices are in range; all offsets are within their buffers after check_ranges.
struct GltfDocument {
    std::string file;
    std::vector<GltfBuffer> buffers;
    std::vector<GltfBufferView> views;
    std::vector<GltfAccessor> accessors;
    std::vector<GltfMesh> meshes;
    std::vector<GltfNode> nodes;
    std::vector<std::size_t> roots;  ///< nodes of the scene to show
    std::vector<GltfImage> images;
    std::vector<GltfTexture> textures;
    std::vector<MaterialDescription> materials;
    std::vector<GltfSkin> skins;
    std::vector<GltfLight> lights;
    std::vector<std::optional<ImportedCamera>> cameras;  ///< without nodes; nullopt: ignored
};

}  // namespace rowland::scene

#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/mesh.h"

namespace rowland::scene {

/// glTF metallic-roughness material, linear factors. Unknown material extensions are kept as JSON for whoever
/// registered a handler; the engine learns nothing of them.
struct MaterialDescription {
    std::string name;
    glm::vec4 base_colour{1.0F};
    float metallic = 1.0F;
    float roughness = 1.0F;
    glm::vec3 emissive{0.0F};
    std::map<std::string, nlohmann::json> extensions;
};

/// A mesh instance with its world transform.
struct ImportedInstance {
    std::string name;
    glm::mat4 transform{1.0F};
    std::size_t mesh = 0;
    std::optional<std::size_t> material;
};

struct ImportedScene {
    std::vector<Mesh> meshes;  ///< one a triangle primitive
    std::vector<MaterialDescription> materials;
    std::vector<ImportedInstance> instances;
    std::vector<std::string> warnings;  ///< optional extensions we ignore, each once; attributes we repaired
};

/// Loads a .gltf or .glb file, Draco-compressed or not, from a possibly hostile file: sizes, offsets, indices and
/// depths are checked before use. `handled_extensions` are material extensions someone has a handler for; any other
/// *required* extension is refused by name. Missing normals and tangents are generated. Throws Error (input).
/// `read_files`, if given, receives every file read (for dependency tracking).
ImportedScene load_gltf(const std::filesystem::path& path, std::span<const std::string> handled_extensions = {},
                        std::vector<std::filesystem::path>* read_files = nullptr);

/// The same for the bytes of a self-contained file; `file` is its name for messages.
ImportedScene load_glb(std::span<const std::byte> bytes, const std::string& file,
                       std::span<const std::string> handled_extensions = {});

/// All triangles of a scene in world space as one mesh (for previews with one material). Mirrored instances keep their
/// outside outside. Throws Error (input) if the copies together are unreasonably large.
Mesh merge_instances(const ImportedScene& scene);

}  // namespace rowland::scene

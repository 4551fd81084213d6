#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/file.h"
#include "engine/scene/glb_write.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/texture_recipe.h"

namespace rowland::scene {

/// A hand-written scene: textures to paint, meshes to build, and nodes with their transforms. The file refers to
/// elements by name, these structs by index.
struct SceneRecipe {
    struct Part {
        MeshRecipe shape;
        std::size_t material = 0;
    };

    GlbScene scene;                         ///< textures without pixels, meshes without primitives
    std::vector<TextureRecipe> textures;    ///< one per texture of `scene`
    std::vector<std::vector<Part>> meshes;  ///< one per mesh of `scene`
    std::string file;                       ///< for messages
};

/// Whether a JSON document is a scene recipe: an object with the key "scene".
bool is_scene_recipe(const nlohmann::json& document);

/// Reads `{"scene": {"textures": […], "materials": […], "meshes": […], "cameras": […], "lights": […], "nodes": […]}}`;
/// the format of scene_recipe.schema.json. Names are unique within an array, and a node's parent comes before it.
/// Textures and materials keep their order in the file that is written, so that a material's extensions may refer to
/// textures by number. Throws Error (input).
SceneRecipe parse_scene_recipe(const nlohmann::json& document, const std::string& file);

/// As rowland::read_file.
using ReadFile = std::function<std::vector<std::byte>(const std::filesystem::path& path, std::uint64_t max_bytes)>;

/// Reads and paints the textures and builds the meshes. Throws Error (input) for a picture that is no PNG, and if there
/// are unreasonably many vertices or texels in all.
GlbScene build_scene(const SceneRecipe& recipe, const ReadFile& read = read_file);

}  // namespace rowland::scene

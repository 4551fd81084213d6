#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/glb_write.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/texture_recipe.h"

namespace rowland::scene {

/// A scene described by hand: textures to paint, meshes to build, and how they stand together. References are names in
/// the file, and places in these arrays here.
struct SceneRecipe {
    struct Texture {
        std::string name;
        TextureRecipe recipe;
        bool clamp_x = false;  ///< or it repeats
        bool clamp_y = false;
    };
    struct Part {
        MeshRecipe shape;
        std::size_t material = 0;
    };
    struct SceneMesh {
        std::string name;
        std::vector<Part> parts;
    };

    std::vector<Texture> textures;
    std::vector<GlbMaterial> materials;
    std::vector<SceneMesh> meshes;
    std::vector<GlbCamera> cameras;
    std::vector<GlbLight> lights;
    std::vector<GlbNode> nodes;
    std::string file;  ///< for messages
};

/// Whether a JSON document is a scene recipe: an object with the key "scene".
bool is_scene_recipe(const nlohmann::json& document);

/// Reads `{"scene": {"textures": […], "materials": […], "meshes": […], "cameras": […], "lights": […], "nodes": […]}}`;
/// scene_recipe.schema.json says what may stand there. Names are unique within an array, and a node's parent comes
/// before it. Textures and materials keep their order in the file that is written, so that a material's extensions may
/// refer to textures by number. Throws Error (input) that names `file`, the place and the nearest valid name.
SceneRecipe parse_scene_recipe(const nlohmann::json& document, const std::string& file);

/// Paints the textures and builds the meshes. Throws Error (input) if there are unreasonably many vertices or texels in
/// all.
GlbScene build_scene(const SceneRecipe& recipe);

}  // namespace rowland::scene

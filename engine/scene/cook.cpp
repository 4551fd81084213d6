#include "engine/scene/cook.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/core/json_schema.h"
#include "engine/scene/cooked_scene.h"
#include "engine/scene/glb_write.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/mesh_recipe.h"

namespace rowland::scene {

namespace {

Mesh build_source(cook::Context& context) {
    const nlohmann::json document = context.read_json(context.source());
    return build_mesh(parse_mesh_recipe(document, context.source().string()));
}

std::vector<std::byte> cook_mesh(cook::Context& context) {
    const Mesh mesh = build_source(context);
    return write_glb(mesh, context.source().stem().string());
}

std::string describe_triangles(const Mesh& mesh) {
    const Bounds box = bounds(mesh);
    return fmt::format("vertices: {}\ntriangles: {}\nminimum: {} {} {}\nmaximum: {} {} {}\n", mesh.positions.size(),
                       mesh.indices.size() / 3, box.minimum.x, box.minimum.y, box.minimum.z, box.maximum.x,
                       box.maximum.y, box.maximum.z);
}

std::string describe_mesh(std::span<const std::byte> payload, const std::string& file) {
    return "format: glTF 2.0 binary, Draco\n" + describe_triangles(merge_instances(load_glb(payload, file)));
}

/// An asset that is a .glb file without a container.
cook::AssetType glb_type(const std::string& name, int version) {
    cook::AssetType type;
    type.name = name;
    type.version = version;
    type.extension = ".glb";
    type.in_container = false;
    return type;
}

cook::AssetType mesh_type() {
    cook::AssetType type = glb_type("mesh", 5);
    type.schema = [] { return json_schema("Rowland mesh recipe", [](JsonReader& json) { parse_mesh_recipe(json); }); };
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && is_mesh_recipe(*json);
    };
    type.cook = cook_mesh;
    type.check = [](cook::Context& context) { build_source(context); };
    type.describe = describe_mesh;
    return type;
}

}  // namespace

void register_cook_types(cook::Registry& registry) {
    registry.add(mesh_type());
    register_scene_type(registry);
}

}  // namespace rowland::scene

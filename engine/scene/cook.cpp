#include "engine/scene/cook.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "engine/scene/glb_write.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/scene_recipe.h"

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

std::string describe_scene(const ImportedScene& scene) {
    return "format: glTF 2.0\n" + describe_triangles(merge_instances(scene)) +
           fmt::format("nodes: {}\nmeshes: {}\nmaterials: {}\ntextures: {}\nskins: {}\nanimations: {}\nlights: {}\n",
                       scene.nodes.size(), scene.meshes.size(), scene.materials.size(), scene.textures.size(),
                       scene.skins.size(), scene.animations.size(), scene.lights.size());
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
    cook::AssetType type = glb_type("mesh", 4);
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && is_mesh_recipe(*json);
    };
    type.cook = cook_mesh;
    type.check = [](cook::Context& context) { build_source(context); };
    type.describe = describe_mesh;
    return type;
}

GlbScene build_scene_source(cook::Context& context) {
    const nlohmann::json document = context.read_json(context.source());
    return build_scene(
        parse_scene_recipe(document, context.source().string()),
        [&](const std::filesystem::path& path, std::uint64_t max_bytes) { return context.read(path, max_bytes); });
}

cook::AssetType scene_type() {
    cook::AssetType type = glb_type("scene", 2);
    type.recognises = [](const std::filesystem::path&, const nlohmann::json* json) {
        return json != nullptr && is_scene_recipe(*json);
    };
    type.cook = [](cook::Context& context) { return write_glb(build_scene_source(context)); };
    type.check = [](cook::Context& context) { build_scene_source(context); };
    return type;
}

std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

void check_extensions(const ImportedScene& scene, const std::string& file,
                      const std::vector<cook::GltfExtension>& extensions) {
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        for (const cook::GltfExtension& extension : extensions)
            if (const auto found = scene.materials[i].extensions.find(extension.name);
                found != scene.materials[i].extensions.end())
                extension.describe(found->second, file, fmt::format("/materials/{}/extensions/{}", i, extension.name));
}

cook::AssetType gltf_type(const std::vector<cook::GltfExtension>& extensions, const std::vector<std::string>& names) {
    cook::AssetType type = glb_type("gltf", 1);
    type.recognises = [](const std::filesystem::path& source, const nlohmann::json*) {
        const std::string extension = lower_extension(source);
        return extension == ".gltf" || extension == ".glb";
    };
    type.check = [extensions, names](cook::Context& context) {
        std::vector<std::filesystem::path> files;
        const ImportedScene scene = load_gltf(context.source(), names, &files);
        merge_instances(scene);
        check_extensions(scene, context.source().string(), extensions);
        for (const std::filesystem::path& file : files) context.depend_on(file);
    };
    return type;
}

}  // namespace

void register_cook_types(cook::Registry& registry) {
    const std::vector<std::string> names = registry.gltf_extension_names();
    registry.add(mesh_type());
    for (cook::AssetType type : {scene_type(), gltf_type(registry.gltf_extensions(), names)}) {
        type.describe = [names](std::span<const std::byte> payload, const std::string& file) {
            return describe_scene(load_glb(payload, file, names));
        };
        registry.add(std::move(type));
    }
}

}  // namespace rowland::scene

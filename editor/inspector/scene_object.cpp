#include "editor/inspector/scene_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <map>
#include <utility>

#include "editor/inspector/preview_shape.h"
#include "engine/render/surface_textures.h"
#include "engine/render/world_bounds.h"
#include "engine/scene/gltf_import.h"
#include "modules/diffraction/asset/gltf_extension.h"

namespace rowland::inspector {

namespace {

scene::Transform fit_of(const scene::ImportedScene& imported) {
    std::vector<scene::Bounds> of_meshes;
    for (const scene::Mesh& mesh : imported.meshes) of_meshes.push_back(scene::bounds(mesh));
    std::vector<scene::Bounds> boxes;
    for (const scene::ImportedInstance& instance : imported.instances)
        boxes.push_back(render::transformed(of_meshes[instance.mesh], instance.transform));
    const scene::Bounds box = render::united(boxes).value_or(scene::Bounds{});
    const float scale = fitting_scale(box);
    return {.translation = -scale * 0.5F * (box.minimum + box.maximum),
            .rotation = {1.0F, 0.0F, 0.0F, 0.0F},
            .scale = glm::vec3(scale)};
}

/// Gives every shown primitive without a material glTF's default one, so that it can be given a grating.
std::vector<scene::PrimitiveId> add_default_materials(scene::ImportedScene& imported) {
    std::vector<scene::PrimitiveId> without_material;
    std::map<std::size_t, std::size_t> material_of_mesh;
    for (scene::ImportedInstance& instance : imported.instances) {
        if (instance.material) continue;
        const auto [found, added] = material_of_mesh.emplace(instance.mesh, imported.materials.size());
        instance.material = found->second;
        if (!added) continue;
        without_material.push_back(imported.primitives[instance.mesh]);
        imported.materials.emplace_back().name = instance.name + " (no material)";
    }
    return without_material;
}

std::vector<SceneMaterial> materials_of(const scene::ImportedScene& imported) {
    std::vector<SceneMaterial> materials;
    for (const scene::MaterialDescription& description : imported.materials)
        materials.push_back({description.name.empty() ? fmt::format("#{}", materials.size()) : description.name, {}});
    for (const scene::ImportedInstance& instance : imported.instances) {
        if (!instance.material) continue;
        SceneMaterial& material = materials[*instance.material];
        material.tangents = std::max(material.tangents, imported.tangents[instance.mesh]);
        const bool told = !material.meshes.empty() && material.meshes.back() == instance.name;
        if (!told) material.meshes.push_back(instance.name);
    }
    for (SceneMaterial& material : materials) {
        std::ranges::sort(material.meshes);
        const auto repeated = std::ranges::unique(material.meshes);
        material.meshes.erase(repeated.begin(), repeated.end());
    }
    return materials;
}

}  // namespace

std::shared_ptr<const SceneObject> load_scene_object(const std::filesystem::path& file) {
    const std::array<std::string, 1> handled = {diffraction::kGltfExtension};
    SceneObject object{.file = file,
                       .imported = scene::load_gltf(file, handled),
                       .meshes = {},
                       .materials = {},
                       .without_material = {},
                       .fit = {}};
    object.without_material = add_default_materials(object.imported);
    scene::pose_skins_at_rest(object.imported);
    object.fit = fit_of(object.imported);
    object.materials = materials_of(object.imported);
    for (scene::Mesh& mesh : std::exchange(object.imported.meshes, {}))
        object.meshes.push_back(std::make_shared<const scene::Mesh>(std::move(mesh)));
    return std::make_shared<const SceneObject>(std::move(object));
}

SceneUpload upload(const SceneObject& scene) {
    SceneUpload made;
    for (const auto& mesh : scene.meshes) made.meshes.push_back({mesh, std::make_shared<render::GpuMesh>(*mesh)});
    render::SurfaceTextures textures(scene.imported);
    for (const scene::MaterialDescription& description : scene.imported.materials)
        made.materials.push_back(render::make_material(&description, textures));
    return made;
}

}  // namespace rowland::inspector

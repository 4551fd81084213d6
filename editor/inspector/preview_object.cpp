#include "editor/inspector/preview_object.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <numbers>
#include <utility>

#include "engine/core/check.h"
#include "engine/render/scene_lights.h"
#include "engine/render/surface_textures.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/thin_film/asset/gltf_iridescence.h"

namespace rowland::inspector {

namespace {

constexpr double kSize = 0.116;  ///< metres: the diameter of the demo's disc, which lacks a compact disc's rim

/// Rotates a plane in XZ with normal +Y into XY with normal +Z.
scene::Mesh upright(scene::Mesh mesh) {
    const auto up = [](const glm::vec3& v) { return glm::vec3(v.x, -v.z, v.y); };
    for (glm::vec3& position : mesh.positions) position = up(position);
    for (glm::vec3& normal : mesh.normals) normal = up(normal);
    for (glm::vec4& tangent : mesh.tangents) tangent = glm::vec4(up(glm::vec3(tangent)), tangent.w);
    return mesh;
}

/// Bends a plane in XY around a vertical axis behind it, so that its width spans `angle` radians.
scene::Mesh bent(scene::Mesh mesh, double width, double angle) {
    const auto radius = static_cast<float>(width / angle);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const float azimuth = mesh.positions[i].x / radius;
        const float sine = std::sin(azimuth);
        const float cosine = std::cos(azimuth);
        mesh.positions[i] = {radius * sine, mesh.positions[i].y, radius * (cosine - 1.0F)};
        mesh.normals[i] = {sine, 0.0F, cosine};
        mesh.tangents[i] = {cosine, 0.0F, -sine, mesh.tangents[i].w};
    }
    return mesh;
}

scene::Bounds bounds_of(const scene::ImportedScene& imported) {
    std::vector<scene::Bounds> of_meshes;
    for (const scene::Mesh& mesh : imported.meshes) of_meshes.push_back(scene::bounds(mesh));
    std::vector<scene::Bounds> boxes;
    for (const scene::ImportedInstance& instance : imported.instances)
        boxes.push_back(render::transformed(of_meshes[instance.mesh], instance.transform));
    return render::united(boxes).value_or(scene::Bounds{});
}

scene::Transform fit_of(const scene::Bounds& box) {
    const float scale = fitting_scale(box);
    return {.translation = -scale * 0.5F * (box.minimum + box.maximum),
            .rotation = {1.0F, 0.0F, 0.0F, 0.0F},
            .scale = glm::vec3(scale)};
}

/// Adds glTF's default material to every shown primitive without a material, so that it can get a grating.
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
        material.meshes.push_back(instance.name);
    }
    for (SceneMaterial& material : materials) {
        std::ranges::sort(material.meshes);
        const auto repeated = std::ranges::unique(material.meshes);
        material.meshes.erase(repeated.begin(), repeated.end());
    }
    return materials;
}

}  // namespace

const char* preview_shape_name(PreviewShape shape) {
    constexpr std::array kNames = {"disc", "sphere", "card", "sheet", "model"};
    return kNames.at(static_cast<std::size_t>(shape));
}

std::optional<PreviewShape> parse_preview_shape(std::string_view name) {
    for (const PreviewShape shape : kPreviewShapes)
        if (name == preview_shape_name(shape)) return shape;
    return std::nullopt;
}

scene::Mesh preview_mesh(PreviewShape shape) {
    switch (shape) {
        case PreviewShape::Disc:
            return scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.058});
        case PreviewShape::Sphere:
            return scene::build_mesh(scene::SphereRecipe{.radius = 0.05});
        case PreviewShape::Card:
            return upright(
                scene::build_mesh(scene::PlaneRecipe{.width = kSize, .depth = 0.64 * kSize, .subdivisions = 64}));
        case PreviewShape::Sheet: {
            constexpr double kAngle = 120.0 * std::numbers::pi / 180.0;
            constexpr double kWidth = 1.3 * kSize;
            return bent(
                upright(scene::build_mesh(scene::PlaneRecipe{.width = kWidth, .depth = kSize, .subdivisions = 96})),
                kWidth, kAngle);
        }
        case PreviewShape::Scene:
            break;
    }
    check_failed(__FILE__, __LINE__, "a scene has meshes of its own");
}

float fitting_scale(const scene::Bounds& box) {
    const glm::vec3 extent = box.maximum - box.minimum;
    const float largest = std::max({extent.x, extent.y, extent.z});
    return largest > 0.0F ? static_cast<float>(kSize) / largest : 1.0F;
}

namespace {

std::shared_ptr<const SceneObject> scene_object(const std::filesystem::path& file, scene::ImportedScene imported) {
    SceneObject object{.file = file,
                       .imported = std::move(imported),
                       .meshes = {},
                       .materials = {},
                       .without_material = {},
                       .bounds = {},
                       .fit = {}};
    object.without_material = add_default_materials(object.imported);
    scene::pose_skins_at_rest(object.imported);
    object.bounds = bounds_of(object.imported);
    object.fit = fit_of(object.bounds);
    object.materials = materials_of(object.imported);
    for (scene::Mesh& mesh : std::exchange(object.imported.meshes, {}))
        object.meshes.push_back(std::make_shared<const scene::Mesh>(std::move(mesh)));
    return std::make_shared<const SceneObject>(std::move(object));
}

const std::array<std::string, 3> kHandled = {diffraction::kGltfExtension, thin_film::kIridescenceExtension,
                                             thin_film::kIorExtension};

}  // namespace

std::shared_ptr<const SceneObject> load_scene_object(const std::filesystem::path& file) {
    return scene_object(file, scene::load_gltf(file, kHandled));
}

std::shared_ptr<const SceneObject> load_scene_object(std::span<const std::byte> glb, const std::string& name) {
    return scene_object(name, scene::load_glb(glb, name, kHandled));
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

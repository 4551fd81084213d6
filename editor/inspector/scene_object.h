#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/transform.h"

namespace rowland::inspector {

/// A material of a scene, as a list shows it.
struct SceneMaterial {
    std::string name;
    std::vector<std::string> meshes;                             ///< that use it, each once
    scene::TangentSource tangents = scene::TangentSource::File;  ///< the poorest of those meshes
};

/// A scene file without its gratings, lights and cameras, at rest. Meshes are those of a file's primitives.
struct SceneObject {
    std::filesystem::path file;
    scene::ImportedScene imported;  ///< without meshes
    std::vector<std::shared_ptr<const scene::Mesh>> meshes;
    std::vector<SceneMaterial> materials;  ///< the file's, then one for each primitive in `without_material`
    std::vector<scene::PrimitiveId> without_material;  ///< primitives without a material
    scene::Transform fit;  ///< scales it to the size of the other shapes, and moves it to the origin
};

/// Loads a .gltf or .glb. Runs on any thread. Throws Error (input).
std::shared_ptr<const SceneObject> load_scene_object(const std::filesystem::path& file);

/// The meshes and materials of a scene on the GPU; by the indices of the file.
struct SceneUpload {
    std::vector<render::MeshInstance> meshes;
    std::vector<render::StandardMaterial> materials;
};
SceneUpload upload(const SceneObject& scene);

}  // namespace rowland::inspector

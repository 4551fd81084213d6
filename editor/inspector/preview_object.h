#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/scene/imported_scene.h"
#include "engine/scene/mesh.h"
#include "engine/scene/transform.h"

namespace rowland::inspector {

/// Settings of light and exposure.
struct Stage {
    float rotation_deg = 0.0F;  ///< of the probe about the vertical axis
    float exposure_stops = 0.0F;
    bool lamp = false;  ///< a distant lamp in addition to the probe; it does not rotate with the probe
    float lamp_azimuth_deg = 35.0F;
    float lamp_elevation_deg = 50.0F;
    float lamp_irradiance = 3.0F;

    friend bool operator==(const Stage&, const Stage&) = default;
};

/// What carries the material: a shape, or the document's scene.
enum class PreviewShape { Disc, Sphere, Card, Sheet, Scene };
inline constexpr std::array kPreviewShapes = {PreviewShape::Disc, PreviewShape::Sphere, PreviewShape::Card,
                                              PreviewShape::Sheet, PreviewShape::Scene};

/// "disc", "sphere", "card", "sheet" or, for Scene, "model": the names in saved layouts.
const char* preview_shape_name(PreviewShape shape);
std::optional<PreviewShape> parse_preview_shape(std::string_view name);

/// The mesh of a shape other than Scene, about 0.1 m in size, at the origin. The disc is the demo's and lies in XZ; the
/// card stands in XY; the sheet is a card bent around the vertical by 120°, with the grating vector around the bend.
scene::Mesh preview_mesh(PreviewShape shape);

/// The scale that gives a box the size of the other shapes.
float fitting_scale(const scene::Bounds& box);

/// A material of a scene, as a list shows it.
struct SceneMaterial {
    std::string name;
    std::vector<std::string> meshes;                             ///< the meshes that use it, each once
    scene::TangentSource tangents = scene::TangentSource::File;  ///< the poorest source among those meshes
};

/// A scene file in its rest pose, without its gratings, films, lights and cameras. Each primitive of the file is a
/// mesh.
struct SceneObject {
    std::filesystem::path file;
    scene::ImportedScene imported;  ///< without meshes
    std::vector<std::shared_ptr<const scene::Mesh>> meshes;
    std::vector<SceneMaterial> materials;  ///< the file's, then one for each primitive in `without_material`
    std::vector<scene::PrimitiveId> without_material;  ///< primitives without a material
    scene::Bounds bounds;                              ///< of all instances, in metres
    scene::Transform fit;  ///< scales it to the size of the other shapes, and moves it to the origin
};

/// Loads a .gltf or .glb. Runs on any thread. Throws Error (input).
std::shared_ptr<const SceneObject> load_scene_object(const std::filesystem::path& file);
/// The same for the bytes of a .glb; `name` is for messages.
std::shared_ptr<const SceneObject> load_scene_object(std::span<const std::byte> glb, const std::string& name);

/// The meshes and materials of a scene on the GPU, by the indices of the file.
struct SceneUpload {
    std::vector<render::MeshInstance> meshes;
    std::vector<render::StandardMaterial> materials;
};
SceneUpload upload(const SceneObject& scene);

/// The object of the preview: a shape with the material 0, or a scene. Never changes, so the pointer to it is its
/// identity.
struct PreviewObject {
    PreviewShape shape = PreviewShape::Disc;
    SceneUpload parts;                         ///< of a shape: its mesh, no materials
    std::shared_ptr<const SceneObject> scene;  ///< null: a shape
    bool tilts = false;                        ///< of a scene: nodes without a parent follow PreviewInputs::tilt
};

}  // namespace rowland::inspector

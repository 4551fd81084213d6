#pragma once

#include <filesystem>
#include <memory>
#include <variant>

#include "editor/inspector/document.h"
#include "editor/inspector/scene_object.h"
#include "modules/diffraction/model/efficiency_table.h"

namespace rowland::inspector {

/// A scene and the gratings of its materials.
struct OpenedScene {
    std::shared_ptr<const SceneObject> object;
    Document document;
};

/// Opens a .gltf or .glb; takes seconds. Runs on any thread. Throws Error (input).
OpenedScene open_scene(const std::filesystem::path& path);
bool is_scene_file(const std::filesystem::path& path);
/// A PNG or JPEG, for groove textures.
bool is_picture_file(const std::filesystem::path& path);

/// The source of a light; loading it takes seconds, so that is left to load_light().
struct LightSource {
    std::filesystem::path path;
};

using OpenedFile = std::variant<Document, LightSource, diffraction::EfficiencyTable>;

/// Opens a file that the user named or dropped: a material, a probe (image or recipe), or a table of efficiencies
/// (.csv). Throws Error (input).
OpenedFile open_file(const std::filesystem::path& path);

/// Whether opening the file replaces the material: not if it is a light, a table, or will be refused.
bool replaces_material(const std::filesystem::path& path);

}  // namespace rowland::inspector

#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/cook/registry.h"

namespace rowland::editor {

struct AttachOptions {
    std::filesystem::path scene;
    /// Materials, each with a source of an asset type that becomes a glTF extension.
    std::vector<std::pair<std::string, std::filesystem::path>> attached;
    std::vector<std::string> removed;              ///< materials that lose their grating or film
    std::optional<double> rotation_deg;            ///< of the grooves that are attached
    std::optional<std::filesystem::path> texture;  ///< an image for what is attached
    std::optional<std::filesystem::path> output;   ///< none: `scene`
    std::optional<std::filesystem::path> depfile;
};

/// Sets extensions of a glTF's materials; all else keeps its value and order. A material is given by its name, or as
/// "#" and its index from 0. All is checked as the engine would before anything is written. Throws Error (input), also
/// for a name that no material or more than one has, and Error (system) as EditableGltf::save() does.
void attach(const cook::Registry& registry, const AttachOptions& options);

/// Prints a header, then a line for each material, and one for primitives without a material: number, name, what is
/// attached, the meshes that use it; separated by tabs. Logs what is refused. Returns the exit code: 2 if something was
/// refused, else 0. Throws Error (input) if the scene cannot be read.
int list_materials(const cook::Registry& registry, const std::filesystem::path& scene);

}  // namespace rowland::editor

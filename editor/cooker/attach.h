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
    std::vector<std::string> removed;              ///< materials that lose what modules attached
    std::optional<double> rotation_deg;            ///< of the one that is attached
    std::optional<std::filesystem::path> texture;  ///< an image for the one that is attached
    std::optional<std::filesystem::path> output;   ///< none: `scene`
    std::optional<std::filesystem::path> depfile;
};

/// Sets extensions of a glTF's materials; all else keeps its value and order. Materials are named, or "#" and the
/// number from 0. All is checked as the engine would before anything is written. Throws Error (input), for a name that
/// no material or more than one has as well, and Error (system) as EditableGltf::save() does.
void attach(const cook::Registry& registry, const AttachOptions& options);

/// A line for each material: its number, its name, what is attached, the meshes that use it; separated by tabs. What is
/// refused is logged. Returns the exit code.
int list_materials(const cook::Registry& registry, const std::filesystem::path& scene);

}  // namespace rowland::editor

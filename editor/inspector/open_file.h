#pragma once

#include <filesystem>
#include <optional>
#include <variant>

#include "editor/inspector/document.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/model/efficiency_table.h"

namespace rowland::inspector {

/// A glTF file: its meshes as one, fitted to the preview, and its first grating as the start of a new material.
struct OpenedModel {
    scene::Mesh mesh;
    std::optional<Document> document;
};

/// The source of a light; loading it takes seconds, so that is left to load_light().
struct LightSource {
    std::filesystem::path path;
};

using OpenedFile = std::variant<Document, OpenedModel, LightSource, diffraction::EfficiencyTable>;

/// Opens a file that the user named or dropped: a material, a glTF file, a probe (image or recipe), or a table of
/// efficiencies (.csv). Throws Error (input).
OpenedFile open_file(const std::filesystem::path& path);

/// Whether opening the file replaces the material: not if it is a light, a table, or will be refused.
bool replaces_material(const std::filesystem::path& path);

}  // namespace rowland::inspector

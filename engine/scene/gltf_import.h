#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_source.h"
#include "engine/scene/imported_scene.h"

namespace rowland::scene {

/// Loads a .gltf or .glb file, which may be Draco-compressed and hostile: sizes, offsets, indices and depths are
/// checked before use. `handled_extensions` are the material extensions with a registered handler; any other *required*
/// extension is refused by name. Missing normals and tangents are generated. Throws Error (input). `read_files`, if
/// given, receives every file read (for dependency tracking).
ImportedScene load_gltf(const std::filesystem::path& path, std::span<const std::string> handled_extensions = {},
                        std::vector<std::filesystem::path>* read_files = nullptr);

/// The same for what split_gltf() returned.
ImportedScene import_gltf(const GltfSource& source, std::span<const std::string> handled_extensions,
                          std::vector<std::filesystem::path>* read_files);
/// The same for the bytes of a self-contained file; `file` is its name for messages.
ImportedScene load_glb(std::span<const std::byte> bytes, const std::string& file,
                       std::span<const std::string> handled_extensions = {});

/// Replaces every skinned instance by its mesh in the rest pose, at a new node at the origin, and removes the skins.
void pose_skins_at_rest(ImportedScene& scene);

/// All triangles of a scene in world space as one mesh, for previews with one material: positions, normals, tangents
/// and first UVs. Skins are in their rest pose, and mirrored instances keep their winding. Throws Error (input) if the
/// result takes more than MemoryBudget::scene_limit(), or if a vertex leaves the range of floats.
Mesh merge_instances(const ImportedScene& scene);

}  // namespace rowland::scene

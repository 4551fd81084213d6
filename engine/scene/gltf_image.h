#pragma once

#include <filesystem>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// Fills the images and textures of `scene` from a checked document. Images that a texture names are decoded, each
/// once; in place of the others, and for textures without an image, stands a white texel, so that indices are the
/// file's and always valid. Throws Error (input).
void import_images(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                   std::vector<std::filesystem::path>* read_files, ImportedScene& scene);

}  // namespace rowland::scene

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/scene/gltf_document.h"
#include "engine/scene/gltf_source.h"
#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// The bytes that a URI of the file names: a data URI, or a file in the glTF's folder or below it, nothing else.
/// `pointer` is the URI's owner. `read_files`, if given, receives the file. Throws Error (input).
GltfBuffer load_uri(const GltfSource& source, const std::string& uri, const std::string& pointer, MemoryBudget& budget,
                    std::vector<std::filesystem::path>* read_files);

/// The buffers of a parsed file: what their URIs name, or the BIN chunk. A buffer holds its byteLength, or nothing if
/// no buffer view uses it. Throws Error (input).
std::vector<GltfBuffer> load_buffers(const GltfSource& source, const GltfDocument& document, MemoryBudget& budget,
                                     std::vector<std::filesystem::path>* read_files);

}  // namespace rowland::scene

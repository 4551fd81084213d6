#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/memory_budget.h"

namespace rowland::scene {

/// A glTF file taken apart: its JSON and, of a GLB, its binary chunk.
struct GltfSource {
    std::string file;                             ///< as the user named it, for messages
    std::optional<std::filesystem::path> folder;  ///< where the files it names are; none: it may name no files
    nlohmann::json json;
    std::vector<std::byte> bytes;   ///< the whole file
    std::size_t binary_offset = 0;  ///< of the BIN chunk's data within `bytes`
    std::size_t binary_size = 0;    ///< 0 if there is none

    std::span<const std::byte> binary() const { return std::span(bytes).subspan(binary_offset, binary_size); }
};

/// Takes apart the bytes of a .gltf or .glb. Checks the GLB header and chunk lengths, and the JSON's size and depth
/// before it is parsed. Throws Error (input).
GltfSource split_gltf(std::vector<std::byte> bytes, std::string file, std::optional<std::filesystem::path> folder);

/// One of a file's buffers; owned unless it is the GLB's binary chunk.
struct GltfBuffer {
    std::vector<std::byte> owned;
    std::span<const std::byte> bytes;
};

/// The bytes that a URI of the file names: a data URI, or a file in the glTF's folder or below it, nothing else.
/// `place` is the URI's owner. `read_files`, if given, receives the file. Throws Error (input).
GltfBuffer load_uri(const GltfSource& source, const std::string& uri, const std::string& place, MemoryBudget& budget,
                    std::vector<std::filesystem::path>* read_files);

/// The buffers of a source whose JSON has been checked: what their URIs name, or the BIN chunk. Each
/// buffer holds at least its byteLength. `read_files`,
/// if given, receives the files read. Throws Error (input).
std::vector<GltfBuffer> load_buffers(const GltfSource& source, MemoryBudget& budget,
                                     std::vector<std::filesystem::path>* read_files);

}  // namespace rowland::scene

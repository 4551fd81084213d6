#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rowland::scene {

/// The JSON of a glTF file and, of a GLB, its binary chunk.
struct GltfSource {
    std::string file;                             ///< as the user named it, for messages
    std::optional<std::filesystem::path> folder;  ///< of the files it names; nullopt: it may name none
    nlohmann::json json;
    std::vector<std::byte> bytes;   ///< the whole file
    std::size_t json_offset = 0;    ///< of the JSON's text within `bytes`; 0: the file is a .gltf
    std::size_t json_size = 0;      ///< bytes
    std::size_t binary_offset = 0;  ///< of the BIN chunk's data within `bytes`
    std::size_t binary_size = 0;    ///< 0 if there is none

    bool is_glb() const { return json_offset > 0; }
    std::span<const std::byte> json_text() const { return std::span(bytes).subspan(json_offset, json_size); }
    std::span<const std::byte> binary() const { return std::span(bytes).subspan(binary_offset, binary_size); }
};

/// Splits the bytes of a .gltf or .glb. Checks the GLB header and chunk lengths, and the JSON's size and depth before
/// it is parsed. Throws Error (input).
GltfSource split_gltf(std::vector<std::byte> bytes, std::string file, std::optional<std::filesystem::path> folder);

}  // namespace rowland::scene

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/json_reader.h"

namespace rowland::scene {

/// Limits the memory that one file may make us use. Every size that a file names is spent here before it is allocated,
/// so a small file cannot ask for gigabytes, neither at once nor by naming the same data a thousand times.
class MemoryBudget {
 public:
    /// Of a scene, in bytes: 512 MiB, or what the environment variable ROWLAND_SCENE_MEMORY allows, at most 4095 MiB.
    static std::uint64_t scene_limit();
    static constexpr const char* kRemedy =
        "split the scene, or allow more MiB by the environment variable ROWLAND_SCENE_MEMORY";

    explicit MemoryBudget(std::string file, std::uint64_t limit_bytes = scene_limit());

    /// Takes `count` elements of `element_bytes`. Throws Error (input) at `pointer` if that is more than is left.
    void spend(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer);
    /// The same check without taking anything, for memory that is freed again before anything else is spent.
    void require_left(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer) const;

 private:
    std::string file_;
    std::uint64_t limit_;
    std::uint64_t left_;
};

/// The JSON of a glTF file and, of a GLB, its binary chunk.
struct GltfSource {
    static constexpr std::uint32_t kMagic = 0x46546C67;        ///< "glTF"
    static constexpr std::uint32_t kJsonChunk = 0x4E4F534A;    ///< "JSON"
    static constexpr std::uint32_t kBinaryChunk = 0x004E4942;  ///< "BIN"

    std::string file;                             ///< as the user named it, for messages
    std::optional<std::filesystem::path> folder;  ///< of the files it names; nullopt: it may name none
    nlohmann::json json;
    std::vector<std::byte> bytes;   ///< the whole file
    std::size_t json_offset = 0;    ///< of the JSON's text within `bytes`; 0: the file is a .gltf
    std::size_t json_size = 0;      ///< bytes
    std::size_t binary_offset = 0;  ///< of the BIN chunk's data within `bytes`
    std::size_t binary_size = 0;    ///< 0 if there is none
    std::size_t glb_size = 0;       ///< total length in the header of a GLB, bytes

    bool is_glb() const { return json_offset > 0; }
    /// The text of the JSON, without the zeros with which some exporters pad a GLB's chunk in place of spaces.
    std::span<const std::byte> json_text() const;
    std::span<const std::byte> binary() const { return std::span(bytes).subspan(binary_offset, binary_size); }
    /// The chunks of a GLB after JSON and BIN; empty for a .gltf.
    std::span<const std::byte> other_chunks() const {
        const std::size_t begin = binary_offset > 0 ? binary_offset + binary_size : json_offset + json_size;
        return is_glb() ? std::span(bytes).subspan(begin, glb_size - begin) : std::span<const std::byte>();
    }
};

/// Splits the bytes of a .gltf or .glb. Checks the GLB header and chunk lengths, and the JSON's size and depth before
/// it is parsed. Throws Error (input).
GltfSource split_gltf(std::vector<std::byte> bytes, std::string file, std::optional<std::filesystem::path> folder);

/// Throws Error (input) unless the version is 2.x and minVersion, if any, is 2.0 (glTF 2.0 specification, §3.2).
void check_gltf_version(JsonReader asset);

/// The length of a GLB chunk for `bytes` bytes of data: the next multiple of 4.
constexpr std::size_t padded_chunk(std::size_t bytes) {
    return (bytes + 3) / 4 * 4;
}

/// The beginning of a GLB: its header, the JSON chunk and, if there is one, the header of the BIN chunk. Its
/// `binary_size` bytes of data, padded by zeros, and other chunks of `other_size` bytes follow. Throws Error (input)
/// naming `file` if the whole is more than a GLB can hold.
std::vector<std::byte> glb_beginning(std::string json, std::optional<std::size_t> binary_size, std::size_t other_size,
                                     const std::string& file);

/// The path of the file that a URI of the glTF `file` names, relative to the glTF's folder, which it does not leave.
/// `pointer` is the JSON pointer of the URI's owner. Throws Error (input).
std::filesystem::path relative_path_of_uri(const std::string& file, const std::string& uri, const std::string& pointer);
/// The same in the source's folder. Throws Error (input), also for a source without one.
std::filesystem::path file_of_uri(const GltfSource& source, const std::string& uri, const std::string& pointer);

/// The data of a buffer: `bytes` lie in `owned` or in the glTF's own bytes.
struct GltfBuffer {
    std::vector<std::byte> owned;
    std::span<const std::byte> bytes;
};

/// The bytes that a URI of the file names: a data URI, or a file in the glTF's folder or below it, nothing else.
/// `pointer` is that of the URI's owner. `read_files`, if given, receives the file. Throws Error (input).
GltfBuffer load_uri(const GltfSource& source, const std::string& uri, const std::string& pointer, MemoryBudget& budget,
                    std::vector<std::filesystem::path>* read_files);

}  // namespace rowland::scene

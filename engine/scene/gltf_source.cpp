#include "engine/scene/gltf_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/core/json_reader.h"

namespace rowland::scene {

namespace {

// They bound the memory of the parsed JSON: a value takes 16 bytes, twice that in a growing array, and there is at most
// one value per comma. A scene of a hundred thousand nodes stays far below both limits.
constexpr std::size_t kMaximumJsonBytes = 64U << 20;
constexpr std::ptrdiff_t kMaximumJsonCommas = 4'000'000;

constexpr std::string_view kMagic = "glTF";
constexpr std::uint32_t kChunkJson = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kChunkBinary = 0x004E4942;

nlohmann::json parse_text(std::span<const std::byte> bytes, const std::string& file) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (text.size() > kMaximumJsonBytes)
        refuse_input(file, "", fmt::format("{} bytes of JSON", text.size()),
                     fmt::format("at most {}", kMaximumJsonBytes),
                     "move embedded buffers into a .bin file, or write a .glb");
    if (std::count(text.begin(), text.end(), ',') > kMaximumJsonCommas)
        refuse_input(file, "", "too many JSON values", fmt::format("at most {}", kMaximumJsonCommas),
                     "move embedded buffers into a .bin file, or write a .glb");
    return parse_json(text, file);
}

/// The next chunk's type and data. Chunk lengths are bounded by the reader.
struct Chunk {
    std::uint32_t type;
    std::span<const std::byte> data;
};
Chunk read_chunk(ByteReader& reader) {
    const auto length = reader.value<std::uint32_t>();
    const auto type = reader.value<std::uint32_t>();
    return {type, reader.take(length)};
}

/// Reads the GLB structure (glTF 2.0, 4.4). Bytes after the header's length are padding and ignored.
void split_binary(GltfSource& source) {
    ByteReader header(source.bytes, source.file);
    header.take(kMagic.size());
    const auto version = header.value<std::uint32_t>();
    if (version != 2) header.fail(fmt::format("GLB version {}", version), "2");
    const auto length = header.value<std::uint32_t>();
    if (length > source.bytes.size())
        header.fail(fmt::format("a file of {} bytes that says it has {}", source.bytes.size(), length),
                    "the whole file");
    const std::size_t header_size = header.offset();
    if (length < header_size) header.fail(fmt::format("total length {}", length), "at least the header's");

    ByteReader reader(std::span(source.bytes).first(length), source.file);
    reader.take(header_size);
    const Chunk json = read_chunk(reader);
    if (json.type != kChunkJson) reader.fail("a first chunk that is not JSON", "a JSON chunk");
    source.json_size = json.data.size();
    source.json_offset = reader.offset() - json.data.size();
    // Chunks of other types are for extensions and skipped; BIN, if there is one, comes right after JSON.
    constexpr std::size_t kChunkHeader = 8;
    if (reader.remaining() < kChunkHeader) return;
    const Chunk second = read_chunk(reader);
    if (second.type != kChunkBinary) return;
    source.binary_size = second.data.size();
    source.binary_offset = reader.offset() - second.data.size();
}

}  // namespace

GltfSource split_gltf(std::vector<std::byte> bytes, std::string file, std::optional<std::filesystem::path> folder) {
    GltfSource source;
    source.file = std::move(file);
    source.folder = std::move(folder);
    source.bytes = std::move(bytes);
    const std::string_view start(reinterpret_cast<const char*>(source.bytes.data()),
                                 std::min(source.bytes.size(), kMagic.size()));
    if (start == kMagic)
        split_binary(source);
    else
        source.json_size = source.bytes.size();
    source.json = parse_text(source.json_text(), source.file);
    return source;
}

}  // namespace rowland::scene

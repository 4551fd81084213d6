#include "engine/scene/gltf_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/core/json_reader.h"
#include "engine/scene/gltf_parse.h"

namespace rowland::scene {

namespace {

// What JSON text can cost once parsed: a value takes 16 bytes and its array up to twice that, and there is at most one
// value a comma. A scene of a hundred thousand nodes stays far below either limit.
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
    source.json = parse_text(json.data, source.file);
    // Chunks of other types are for extensions and skipped; BIN, if there is one, comes right after JSON.
    constexpr std::size_t kChunkHeader = 8;
    if (reader.remaining() < kChunkHeader) return;
    const Chunk second = read_chunk(reader);
    if (second.type != kChunkBinary) return;
    source.binary_size = second.data.size();
    source.binary_offset = reader.offset() - second.data.size();
}

std::string percent_decode(const std::string& uri) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9') return c - '0';
        if (c >= 'a' && c <= 'f') return c - 'a' + 10;
        if (c >= 'A' && c <= 'F') return c - 'A' + 10;
        return -1;
    };
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
            text += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

/// The file a URI names, which is in `folder` or below it. Throws otherwise: a glTF from a stranger must not be able to
/// read (or, by its error messages, probe) other files.
std::filesystem::path resolve(const GltfSource& source, const std::string& uri, const std::string& place) {
    const std::string remedy = "put it beside the glTF file";
    const std::string expected = "the name of a file in the glTF's folder, or base64 data";
    if (!source.folder)
        refuse_input(source.file, place, fmt::format("an external file \"{:.60}\"", uri), "embedded data");
    const std::string name = percent_decode(uri);
    if (name.empty() || name.find('\0') != std::string::npos || name.find(':') != std::string::npos ||
        name.find('\\') != std::string::npos)
        refuse_input(source.file, place, fmt::format("URI \"{:.60}\"", uri), expected, remedy);
    const std::filesystem::path path = std::filesystem::path(name).lexically_normal();
    if (path.is_absolute() || *path.begin() == "..")
        refuse_input(source.file, place, fmt::format("URI \"{:.60}\", outside the glTF's folder", uri), expected,
                     remedy);
    return *source.folder / path;
}

/// Base64 makes three bytes of four characters; less means that the data is not base64 or was cut.
GltfBuffer load_data_uri(const GltfSource& source, const std::string& uri, const std::string& place,
                         MemoryBudget& budget) {
    budget.spend(uri.size() / 4 + 1, 3, place);
    GltfBuffer buffer;
    buffer.owned = decode_data_uri(uri);
    if (buffer.owned.empty()) refuse_input(source.file, place, "a data URI without base64 data", "data:…;base64,…");
    buffer.bytes = buffer.owned;
    return buffer;
}

GltfBuffer load_file(const GltfSource& source, const std::string& uri, const std::string& place, MemoryBudget& budget,
                     std::vector<std::filesystem::path>* read_files) {
    const std::filesystem::path path = resolve(source, uri, place);
    if (read_files) read_files->push_back(path);
    GltfBuffer buffer;
    try {
        buffer.owned = read_file(path, MemoryBudget::kDefaultLimit);
    } catch (const Error& error) {
        // The glTF is what the user named; it is at fault for what it names.
        throw Error({.file = source.file,
                     .place = place,
                     .found = fmt::format("{:.200} {}", uri, error.info().found),
                     .expected = error.info().expected,
                     .remedy = "put it beside the glTF file",
                     .fault = error.info().fault});
    }
    budget.spend(buffer.owned.size(), 1, place);
    buffer.bytes = buffer.owned;
    return buffer;
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
        source.json = parse_text(source.bytes, source.file);
    return source;
}

GltfBuffer load_uri(const GltfSource& source, const std::string& uri, const std::string& place, MemoryBudget& budget,
                    std::vector<std::filesystem::path>* read_files) {
    return uri.starts_with("data:") ? load_data_uri(source, uri, place, budget)
                                    : load_file(source, uri, place, budget, read_files);
}

std::vector<GltfBuffer> load_buffers(const GltfSource& source, MemoryBudget& budget,
                                     std::vector<std::filesystem::path>* read_files) {
    std::vector<GltfBuffer> buffers;
    const auto found = source.json.find("buffers");
    if (found == source.json.end()) return buffers;
    for (std::size_t i = 0; i < found->size(); ++i) {
        const std::string place = fmt::format("/buffers/{}", i);
        const nlohmann::json& entry = (*found)[i];
        const auto length = entry.at("byteLength").get<std::uint64_t>();
        GltfBuffer buffer;
        if (entry.contains("uri")) {
            buffer = load_uri(source, entry.at("uri").get_ref<const std::string&>(), place, budget, read_files);
        } else if (i == 0) {
            buffer.bytes = source.binary();
        }
        if (buffer.bytes.size() < length)
            refuse_input(source.file, place, fmt::format("{} bytes of data", buffer.bytes.size()),
                         fmt::format("the {} bytes of byteLength", length), "the file was cut, or byteLength is wrong");
        buffer.bytes = buffer.bytes.first(static_cast<std::size_t>(length));
        buffers.push_back(std::move(buffer));
    }
    return buffers;
}

}  // namespace rowland::scene

#include "engine/scene/gltf_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <string_view>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/scene/tinygltf.h"

namespace rowland::scene {

namespace {

// These limits bound the memory of the parsed JSON: a value takes 16 bytes, twice that in a growing array, and there is
// at most one value per comma. A scene of a hundred thousand nodes stays far below both limits.
constexpr std::size_t kMaximumJsonBytes = 64U << 20;
constexpr std::ptrdiff_t kMaximumJsonCommas = 4'000'000;

constexpr std::string_view kGlbMagic = "glTF";

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

/// Reads the GLB structure (glTF 2.0, 4.4). Bytes beyond the length in the header are padding and ignored.
void split_binary(GltfSource& source) {
    ByteReader header(source.bytes, source.file);
    header.take(kGlbMagic.size());
    const auto version = header.value<std::uint32_t>();
    if (version != 2) header.fail(fmt::format("GLB version {}", version), "2");
    const auto length = header.value<std::uint32_t>();
    if (length > source.bytes.size())
        header.fail(fmt::format("a file of {} bytes that says it has {}", source.bytes.size(), length),
                    "the whole file");
    const std::size_t header_size = header.offset();
    if (length < header_size) header.fail(fmt::format("total length {}", length), "at least the header's");

    source.glb_size = length;

    ByteReader reader(std::span(source.bytes).first(length), source.file);
    reader.take(header_size);
    const Chunk json = read_chunk(reader);
    if (json.type != GltfSource::kJsonChunk) reader.fail("a first chunk that is not JSON", "a JSON chunk");
    source.json_size = json.data.size();
    source.json_offset = reader.offset() - json.data.size();
    // Chunks of other types are for extensions and skipped; BIN, if there is one, comes right after JSON.
    constexpr std::size_t kChunkHeader = 8;
    if (reader.remaining() < kChunkHeader) return;
    const Chunk second = read_chunk(reader);
    if (second.type != GltfSource::kBinaryChunk) return;
    source.binary_size = second.data.size();
    source.binary_offset = reader.offset() - second.data.size();
}

constexpr const char* kFileRemedy = "put it beside the glTF file";

std::string percent_decode(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        text += uri[i];
        if (uri[i] != '%' || i + 2 >= uri.size()) continue;
        const char* const end = uri.data() + i + 3;
        unsigned code = 0;
        if (std::from_chars(uri.data() + i + 1, end, code, 16).ptr != end) continue;
        text.back() = static_cast<char>(code);
        i += 2;
    }
    return text;
}

std::vector<std::byte> decode_base64(std::string_view base64) {
    // tinygltf decodes data URIs of a few media types only, so the real type is replaced by a known one.
    std::vector<unsigned char> data;
    std::string media_type;
    const std::string known = "data:application/octet-stream;base64," + std::string(base64);
    if (!gltf::DecodeDataURI(&data, media_type, known, 0, false)) return {};
    const auto bytes = std::as_bytes(std::span(data));
    return {bytes.begin(), bytes.end()};
}

/// data:<media type>;base64,<data>
GltfBuffer load_data_uri(const GltfSource& source, const std::string& uri, const std::string& pointer,
                         MemoryBudget& budget) {
    budget.spend(uri.size() / 4 + 1, 3, pointer);
    const std::size_t comma = std::min(uri.find(','), uri.size());
    GltfBuffer buffer;
    if (uri.substr(0, comma).ends_with(";base64") && comma < uri.size())
        buffer.owned = decode_base64(std::string_view(uri).substr(comma + 1));
    if (buffer.owned.empty()) refuse_input(source.file, pointer, "a data URI without base64 data", "data:…;base64,…");
    buffer.bytes = buffer.owned;
    return buffer;
}

GltfBuffer load_file(const GltfSource& source, const std::string& uri, const std::string& pointer, MemoryBudget& budget,
                     std::vector<std::filesystem::path>* read_files) {
    const std::filesystem::path path = file_of_uri(source, uri, pointer);
    if (read_files) read_files->push_back(path);
    GltfBuffer buffer;
    try {
        buffer.owned = read_file(path, MemoryBudget::scene_limit());
    } catch (const Error& error) {
        // The message names the glTF, which is the file that the user named.
        ErrorInfo info = error.info();
        info.file = source.file;
        info.location = pointer;
        info.found = fmt::format("{:.200} {}", uri, info.found);
        info.remedy = kFileRemedy;
        throw Error(std::move(info));
    }
    budget.spend(buffer.owned.size(), 1, pointer);
    buffer.bytes = buffer.owned;
    return buffer;
}

}  // namespace

namespace {

struct Version {
    unsigned major = 0;
    unsigned minor = 0;
};

std::optional<Version> parse_version(std::string_view text) {
    Version version;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.major);
    if (major.ec != std::errc{} || major.ptr == end || *major.ptr != '.') return std::nullopt;
    const auto minor = std::from_chars(major.ptr + 1, end, version.minor);
    return minor.ec == std::errc{} && minor.ptr == end ? std::optional(version) : std::nullopt;
}

}  // namespace

void check_gltf_version(JsonReader asset) {
    const auto check = [&](const std::string& key, unsigned most_minor, const std::string& expected) {
        const std::string text = asset.text(key);
        const std::optional<Version> version = parse_version(text);
        if (!version || version->major != 2 || version->minor > most_minor)
            asset.fail(key, fmt::format("\"{:.20}\"", text), expected, "export the file as glTF 2.0");
    };
    check("version", std::numeric_limits<unsigned>::max(), "glTF version 2");
    if (asset.has("minVersion")) check("minVersion", 0, "2.0: no later version is read");
}

std::span<const std::byte> GltfSource::json_text() const {
    auto text = std::span(bytes).subspan(json_offset, json_size);
    for (int i = 0; i < 3 && is_glb() && !text.empty() && text.back() == std::byte{0}; ++i)
        text = text.first(text.size() - 1);
    return text;
}

std::uint64_t MemoryBudget::scene_limit() {
    return memory_limit("ROWLAND_SCENE_MEMORY", 512, 4095);
}

MemoryBudget::MemoryBudget(std::string file, std::uint64_t limit_bytes)
    : file_(std::move(file)), limit_(limit_bytes), left_(limit_bytes) {}

void MemoryBudget::spend(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer) {
    require_left(count, element_bytes, pointer);
    left_ -= count * element_bytes;
}

void MemoryBudget::require_left(std::uint64_t count, std::uint64_t element_bytes, const std::string& pointer) const {
    if (element_bytes != 0 && count > left_ / element_bytes)
        refuse_input(file_, pointer, fmt::format("{} elements of {} bytes", count, element_bytes),
                     fmt::format("at most {} bytes in the whole scene", limit_), kRemedy);
}

/// A hostile glTF must not read other files, nor probe for them by the error messages.
std::filesystem::path relative_path_of_uri(const std::string& file, const std::string& uri,
                                           const std::string& pointer) {
    const std::string expected = "the name of a file in the glTF's folder, or base64 data";
    const std::string name = percent_decode(uri);
    if (name.empty() || name.find('\0') != std::string::npos || name.find(':') != std::string::npos ||
        name.find('\\') != std::string::npos)
        refuse_input(file, pointer, fmt::format("URI \"{:.60}\"", uri), expected, kFileRemedy);
    std::filesystem::path path = std::filesystem::path(name).lexically_normal();
    if (path.has_root_path() || *path.begin() == "..")
        refuse_input(file, pointer, fmt::format("URI \"{:.60}\", outside the glTF's folder", uri), expected,
                     kFileRemedy);
    return path;
}

std::filesystem::path file_of_uri(const GltfSource& source, const std::string& uri, const std::string& pointer) {
    if (!source.folder)
        refuse_input(source.file, pointer, fmt::format("an external file \"{:.60}\"", uri), "embedded data");
    return *source.folder / relative_path_of_uri(source.file, uri, pointer);
}

GltfSource split_gltf(std::vector<std::byte> bytes, std::string file, std::optional<std::filesystem::path> folder) {
    GltfSource source;
    source.file = std::move(file);
    source.folder = std::move(folder);
    source.bytes = std::move(bytes);
    const std::string_view start(reinterpret_cast<const char*>(source.bytes.data()),
                                 std::min(source.bytes.size(), kGlbMagic.size()));
    if (start == kGlbMagic)
        split_binary(source);
    else
        source.json_size = source.bytes.size();
    source.json = parse_text(source.json_text(), source.file);
    return source;
}

GltfBuffer load_uri(const GltfSource& source, const std::string& uri, const std::string& pointer, MemoryBudget& budget,
                    std::vector<std::filesystem::path>* read_files) {
    return uri.starts_with("data:") ? load_data_uri(source, uri, pointer, budget)
                                    : load_file(source, uri, pointer, budget, read_files);
}

}  // namespace rowland::scene

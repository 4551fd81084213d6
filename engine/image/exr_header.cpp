#include "engine/image/exr.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/byte_stream.h"
#include "engine/core/error.h"
#include "engine/image/image.h"

// Layout: "OpenEXR File Layout", openexr.com, versions 2.0 to 3.1.

namespace rowland::image {

namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kVersion = 2;
constexpr std::uint32_t kTiledFlag = 0x200;
constexpr std::uint32_t kDeepFlag = 0x800;
constexpr std::uint32_t kMultiPartFlag = 0x1000;
constexpr std::size_t kMaximumName = 255;
constexpr std::size_t kMaximumAttributes = 1024;
constexpr std::size_t kMaximumParts = 64;
constexpr std::uint64_t kMaximumChannels = 128;
/// OpenEXR decodes a chunk (a block of lines, a tile) at once, with all channels.
constexpr std::uint64_t kMaximumChunkBytes = std::uint64_t{1} << 28;

/// The sizes in a part's header.
struct Part {
    std::array<std::int32_t, 4> data_window = {};
    bool has_window = false;
    bool tiled = false;
    std::uint64_t tile_width = 0;
    std::uint64_t tile_height = 0;
    std::uint8_t compression = 0;
    std::uint64_t channels = 0;
    std::string type;
};

std::string read_name(ByteReader& reader) {
    std::string name;
    while (true) {
        const auto c = reader.value<char>();
        if (c == '\0') return name;
        name += c;
        if (name.size() > kMaximumName) reader.fail("a name that does not end", "at most 255 characters");
    }
}

/// A channel list: entries of name, type, pLinear, reserved and two samplings, then an empty name.
std::uint64_t count_channels(ByteReader& reader) {
    std::uint64_t count = 0;
    while (!read_name(reader).empty()) {
        reader.take(16);
        if (++count > kMaximumChannels) reader.fail("too many channels", fmt::format("at most {}", kMaximumChannels));
    }
    return count;
}

void read_tiles(ByteReader reader, Part& part) {
    part.tiled = true;
    part.tile_width = reader.value<std::uint32_t>();
    part.tile_height = reader.value<std::uint32_t>();
    if (part.tile_width == 0 || part.tile_height == 0 || part.tile_width > kMaximumSide ||
        part.tile_height > kMaximumSide)
        reader.fail(fmt::format("tiles of {} x {} texels", part.tile_width, part.tile_height),
                    fmt::format("sides in [1, {}]", kMaximumSide));
}

/// The library allocates a preview before it reads it.
void check_preview(ByteReader reader, std::size_t size) {
    const std::uint64_t width = reader.value<std::uint32_t>();
    const std::uint64_t height = reader.value<std::uint32_t>();
    if (width > kMaximumSide || height > kMaximumSide || 4 * width * height + 8 != size)
        reader.fail(fmt::format("a preview of {} x {} texels in {} bytes", width, height, size), "a whole preview");
}

/// The size in bytes of a value of this attribute type; nullopt if the type has no fixed size.
std::optional<std::uint32_t> fixed_size(const std::string& type) {
    static const std::map<std::uint32_t, std::vector<std::string>> kTypes = {
        {1, {"compression", "deepImageState", "envmap", "lineOrder"}},
        {4, {"float", "int"}},
        {8, {"double", "rational", "timecode", "v2f", "v2i"}},
        {9, {"tiledesc"}},
        {12, {"v3f", "v3i"}},
        {16, {"box2f", "box2i", "v2d"}},
        {24, {"v3d"}},
        {28, {"keycode"}},
        {32, {"chromaticities"}},
        {36, {"m33f"}},
        {64, {"m44f"}},
        {72, {"m33d"}},
        {128, {"m44d"}},
    };
    for (const auto& [size, types] : kTypes)
        if (std::find(types.begin(), types.end(), type) != types.end()) return size;
    return std::nullopt;
}

/// Refuses a value whose size is not its type's. The library reads as many bytes as the type has, whatever size the
/// attribute claims, so it would read the next attribute from another position than this check.
void check_value(ByteReader value, const std::string& name, const std::string& type, std::uint32_t size) {
    const auto fixed = fixed_size(type);
    if (fixed && *fixed != size)
        value.fail(fmt::format("attribute \"{}\" of type {} in {} bytes", name, type, size), fmt::format("{}", *fixed));
    if (type == "preview") check_preview(value, size);
    const std::size_t end = value.offset() + size;
    if (type == "chlist") {
        count_channels(value);
        if (value.offset() != end) value.fail("a list of channels of another size than it claims", "a whole one");
    }
    if (type != "stringvector") return;
    while (value.offset() < end) {
        if (end - value.offset() < sizeof(std::uint32_t)) value.fail("a cut list of texts", "whole texts");
        const auto length = value.value<std::uint32_t>();
        if (length > end - value.offset())
            value.fail(fmt::format("a text of {} bytes in attribute \"{}\"", length, name),
                       fmt::format("at most the {} left of it", end - value.offset()));
        value.take(length);
    }
}

/// Reads one attribute of `part`; false at the end of the header.
bool read_attribute(ByteReader& reader, Part& part) {
    const std::string name = read_name(reader);
    if (name.empty()) return false;
    const std::string type = read_name(reader);
    const auto size = reader.value<std::uint32_t>();
    if (size > reader.remaining())
        reader.fail(fmt::format("attribute \"{}\" of {} bytes", name, size),
                    fmt::format("at most the {} bytes left", reader.remaining()));
    ByteReader value = reader;
    reader.take(size);
    check_value(value, name, type, size);
    if (name == "dataWindow" && type == "box2i") {
        for (std::int32_t& edge : part.data_window) edge = value.value<std::int32_t>();
        part.has_window = true;
    } else if (name == "compression" && type == "compression") {
        part.compression = value.value<std::uint8_t>();
    } else if (name == "tiles" && type == "tiledesc") {
        read_tiles(value, part);
    } else if (name == "channels" && type == "chlist") {
        part.channels = count_channels(value);
    } else if (name == "type" && type == "string") {
        const auto text = value.take(size);
        part.type.assign(reinterpret_cast<const char*>(text.data()), text.size());
    }
    return true;
}

std::uint64_t lines_per_chunk(std::uint8_t compression, const ByteReader& reader) {
    // None, RLE, ZIPS, ZIP, PIZ, PXR24, B44, B44A, DWAA, DWAB.
    constexpr std::array<std::uint64_t, 10> kLines = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};
    if (compression >= kLines.size())
        reader.fail(fmt::format("compression {}", compression), fmt::format("at most {}", kLines.size() - 1));
    return kLines[compression];
}

void check_part(const Part& part, const ByteReader& reader) {
    if (part.type.starts_with("deep"))
        reader.fail(fmt::format("a part of type \"{}\"", part.type), "scanlineimage or tiledimage");
    if (!part.has_window) reader.fail("no data window", "the attribute dataWindow");
    const auto& w = part.data_window;
    const std::int64_t width = std::int64_t{w[2]} - w[0] + 1;
    const std::int64_t height = std::int64_t{w[3]} - w[1] + 1;
    check_image_size(width, height, reader.file(), "dataWindow");

    const std::uint64_t lines = lines_per_chunk(part.compression, reader);
    const std::uint64_t chunk_width = part.tiled ? part.tile_width : static_cast<std::uint64_t>(width);
    const std::uint64_t chunk_height = part.tiled ? part.tile_height : lines;
    const std::uint64_t chunk_bytes = chunk_width * chunk_height * std::max<std::uint64_t>(part.channels, 1) * 4;
    if (chunk_bytes > kMaximumChunkBytes)
        reader.fail(fmt::format("chunks of {} x {} texels, {} channels", chunk_width, chunk_height, part.channels),
                    fmt::format("at most {} bytes a chunk", kMaximumChunkBytes));
    // A file has a table of chunk offsets, and each chunk has at least a header of eight bytes.
    const auto whole = [](std::uint64_t a, std::uint64_t b) { return (a + b - 1) / b; };
    const std::uint64_t chunks =
        whole(static_cast<std::uint64_t>(width), chunk_width) * whole(static_cast<std::uint64_t>(height), chunk_height);
    if (chunks > reader.remaining() / 16)
        reader.fail(fmt::format("{} bytes left", reader.remaining()),
                    fmt::format("at least {} for {} x {} texels", 16 * chunks, width, height));
    // The library decodes a row of tiles at a time and keeps a chunk packed, unpacked and rearranged.
    const std::uint64_t row_bytes =
        part.tiled ? whole(static_cast<std::uint64_t>(width), chunk_width) * chunk_bytes : 0;
    check_decoded_bytes(width, height,
                        static_cast<std::uint64_t>(width * height) * sizeof(glm::vec3) + 3 * chunk_bytes + row_bytes,
                        reader.offset() + reader.remaining(), reader.file());
}

}  // namespace

void check_exr_header(std::span<const std::byte> bytes, const std::string& file) {
    ByteReader reader(bytes, file);
    if (reader.value<std::uint32_t>() != kMagic) reader.fail("no OpenEXR magic number", "an OpenEXR file");
    const auto version = reader.value<std::uint32_t>();
    if ((version & 0xff) != kVersion)
        reader.fail(fmt::format("OpenEXR file version {}", version & 0xff), fmt::format("{}", kVersion));
    if ((version & kDeepFlag) != 0) reader.fail("deep data", "a flat image");
    const bool multi_part = (version & kMultiPartFlag) != 0;
    for (std::size_t count = 0;; ++count) {
        if (count > kMaximumParts) reader.fail("too many parts", fmt::format("at most {}", kMaximumParts));
        Part part;
        part.tiled = !multi_part && (version & kTiledFlag) != 0;
        std::size_t attributes = 0;
        while (read_attribute(reader, part))
            if (++attributes > kMaximumAttributes)
                reader.fail("too many attributes", fmt::format("at most {}", kMaximumAttributes));
        if (multi_part && attributes == 0 && count > 0) return;  // the empty header after the last part
        if (part.tiled && part.tile_width == 0) reader.fail("no tile sizes", "the attribute tiles");
        check_part(part, reader);
        if (!multi_part) return;
    }
}

}  // namespace rowland::image

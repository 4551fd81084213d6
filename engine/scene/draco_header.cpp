#include "engine/scene/draco_header.h"

#include <fmt/format.h>

#include <string_view>

#include "engine/core/byte_stream.h"

namespace rowland::scene {

namespace {

std::uint64_t read_varint(ByteReader& reader) {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
        const auto byte = reader.value<std::uint8_t>();
        value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
        if ((byte & 0x80U) == 0) return value;
    }
    reader.fail("a number of more than 64 bits", "a varint");
}

/// Steps over one metadata element: entries of name and value, then children of name and element, in depth-first order.
void skip_metadata_element(ByteReader& reader) {
    for (std::uint64_t pending = 1; pending > 0; --pending) {
        for (std::uint64_t entries = read_varint(reader); entries > 0; --entries) {
            reader.take(reader.value<std::uint8_t>());
            reader.take(read_varint(reader));
        }
        const std::uint64_t children = read_varint(reader);
        // Each child takes at least two bytes, so this also bounds the loop.
        if (children > reader.remaining()) reader.fail(fmt::format("{} metadata children", children), "fewer");
        pending += children;
        // A child's name stands before the child itself; the first child follows at once, its siblings after it.
        if (pending > 1) reader.take(reader.value<std::uint8_t>());
    }
}

/// The number of faces and points a Draco 2.2 stream claims (Draco bitstream specification, 3 to 5).
DracoCounts read_counts(ByteReader& reader) {
    constexpr std::string_view kMagic = "DRACO";
    const auto magic = reader.take(kMagic.size());
    if (std::string_view(reinterpret_cast<const char*>(magic.data()), magic.size()) != kMagic)
        reader.fail("no Draco stream", "one that begins with DRACO");
    const auto major = reader.value<std::uint8_t>();
    const auto minor = reader.value<std::uint8_t>();
    if (major != 2 || minor != 2)
        reader.fail(fmt::format("Draco bitstream {}.{}", major, minor), "2.2, the version of glTF");
    if (reader.value<std::uint8_t>() != 1) reader.fail("a Draco point cloud", "a triangle mesh");
    const auto method = reader.value<std::uint8_t>();
    constexpr std::uint8_t kSequential = 0;
    constexpr std::uint8_t kEdgebreaker = 1;
    if (method != kSequential && method != kEdgebreaker) reader.fail(fmt::format("method {}", method), "0 or 1");
    constexpr unsigned kHasMetadata = 0x8000;
    if ((reader.value<std::uint16_t>() & kHasMetadata) != 0) {
        for (std::uint64_t elements = read_varint(reader); elements > 0; --elements) {
            read_varint(reader);
            skip_metadata_element(reader);
        }
        skip_metadata_element(reader);
    }
    DracoCounts counts;
    if (method == kSequential) {
        counts.faces = read_varint(reader);
        counts.points = read_varint(reader);
    } else {
        reader.value<std::uint8_t>();  // traversal
        counts.points = read_varint(reader);
        counts.faces = read_varint(reader);
    }
    return counts;
}

}  // namespace

DracoCounts read_draco_counts(std::span<const std::byte> stream, const std::string& where) {
    ByteReader reader(stream, where);
    const DracoCounts counts = read_counts(reader);
    // Entropy coding takes a few bits for a face or a point even on regular grids. 64 of them a byte is far beyond what
    // any encoder reaches, and bounds what a small stream can make the decoder allocate.
    const std::uint64_t most = 64 * static_cast<std::uint64_t>(stream.size()) + 4096;
    if (counts.faces > most || counts.points > most)
        reader.fail(fmt::format("{} faces and {} points in {} bytes", counts.faces, counts.points, stream.size()),
                    fmt::format("at most {} of either", most));
    return counts;
}

}  // namespace rowland::scene

#include "engine/image/png_decode.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/limits.h"

// Format: Portable Network Graphics Specification, W3C 2003.

namespace rowland::image {

namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t kChunkFrame = 12;  ///< a chunk's length, type and checksum
constexpr std::size_t kHeaderLength = 13;
/// Deflate makes at most 1032 bytes of one (zlib's technical notes), of 8 texels each.
constexpr std::uint64_t kMaximumTexelsPerPngByte = std::uint64_t{1032} * 8;

[[noreturn]] void fail(const std::string& file, std::size_t at, std::string found, std::string expected) {
    refuse_input(file, fmt::format("byte {}", at), std::move(found), std::move(expected), "export the image again");
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
}

/// A chunk; `framed` with its length, type and checksum.
struct Chunk {
    std::string_view type;
    std::span<const std::byte> framed;
    std::span<const std::byte> data;
};
Chunk chunk_at(std::span<const std::byte> bytes, std::size_t at, const std::string& file) {
    const std::size_t left = bytes.size() - at;
    if (left < kChunkFrame) fail(file, at, "the end of the file", "a PNG chunk");
    const std::size_t length = big_endian(bytes.subspan(at));
    if (length > left - kChunkFrame) fail(file, at, "a PNG chunk that ends beyond the file", "the whole file");
    return {{reinterpret_cast<const char*>(bytes.data()) + at + 4, 4},
            bytes.subspan(at, length + kChunkFrame),
            bytes.subspan(at + 8, length)};
}

/// The chunks that hold the image. Dropped are gamma and profiles, which libpng would apply to the values, and texts,
/// which it would inflate.
std::vector<std::byte> picture_chunks(std::span<const std::byte> bytes, const std::string& file) {
    std::vector<std::byte> kept(bytes.begin(), bytes.begin() + kSignature.size());
    kept.reserve(bytes.size());
    for (std::size_t at = kSignature.size();;) {
        const Chunk chunk = chunk_at(bytes, at, file);
        // An upper-case first letter marks a critical chunk, which libpng refuses if it does not know it.
        const bool critical = chunk.type[0] >= 'A' && chunk.type[0] <= 'Z';
        if (critical || chunk.type == "tRNS") kept.insert(kept.end(), chunk.framed.begin(), chunk.framed.end());
        if (chunk.type == "IEND") return kept;
        at += chunk.framed.size();
    }
}

/// libpng's state of one reading, freed at the end of the scope.
struct Reading {
    png_image image{};
    Reading() { image.version = PNG_IMAGE_VERSION; }
    ~Reading() { png_image_free(&image); }
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

    void check(int succeeded, const std::string& file) const {
        if (succeeded == 0)
            refuse_input(file, "", fmt::format("a broken PNG ({:.60})", image.message), "a whole one",
                         "export the image again");
    }
};

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
    return bytes.size() >= kSignature.size() &&
           std::equal(kSignature.begin(), kSignature.end(), bytes.begin(),
                      [](std::uint8_t a, std::byte b) { return std::byte{a} == b; });
}

ByteImageSize png_size(std::span<const std::byte> bytes, const std::string& file) {
    const Chunk header = chunk_at(bytes, kSignature.size(), file);
    if (header.type != "IHDR" || header.data.size() != kHeaderLength)
        fail(file, kSignature.size(), "no PNG header", "an IHDR chunk");
    const std::int64_t width = big_endian(header.data);
    const std::int64_t height = big_endian(header.data.subspan(4));
    check_image_size(width, height, file, fmt::format("byte {}", kSignature.size()));
    check_compression(width, height, bytes.size(), kMaximumTexelsPerPngByte, file);
    check_decoded_bytes(width, height, 4 * static_cast<std::uint64_t>(width * height), bytes.size(), file);
    return {static_cast<int>(width), static_cast<int>(height)};
}

ByteImage decode_png(std::span<const std::byte> bytes, const std::string& file) {
    const ByteImageSize size = png_size(bytes, file);
    const std::vector<std::byte> picture = picture_chunks(bytes, file);
    Reading reading;
    reading.check(png_image_begin_read_from_memory(&reading.image, picture.data(), picture.size()), file);
    reading.image.format = PNG_FORMAT_RGBA;
    reading.image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;  // 16 bits are encoded like 8
    ByteImage result{size.width, size.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(reading.image))};
    reading.check(png_image_finish_read(&reading.image, nullptr, result.rgba.data(), 0, nullptr), file);
    return result;
}

}  // namespace rowland::image

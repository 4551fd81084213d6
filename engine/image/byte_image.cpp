#include "engine/image/byte_image.h"

#include <fmt/format.h>
#include <png.h>
#include <stb_image_write.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image.h"

// Format: Portable Network Graphics Specification, W3C 2003.

namespace rowland::image {

namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t kChunkFrame = 12;  ///< a chunk's length, type and checksum
constexpr std::size_t kHeaderLength = 13;
/// Deflate expands a byte to at most 1032 bytes (zlib's technical notes), each of which holds at most 8 texels.
constexpr std::uint64_t kMaximumTexelsPerPngByte = std::uint64_t{1032} * 8;

[[noreturn]] void fail(const std::string& file, std::size_t at, std::string found, std::string expected) {
    refuse_input(file, fmt::format("byte {}", at), std::move(found), std::move(expected), "export the image again");
}

std::uint32_t big_endian(std::span<const std::byte> bytes) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | std::to_integer<std::uint32_t>(bytes[i]);
    return value;
}

/// A chunk; `framed` includes its length, type and checksum.
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

/// The file with only the chunks that hold the image: without gamma and profiles, which libpng would apply to the
/// values, and without texts, which it would inflate.
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

/// A block of 8 × 8 texels takes at least one bit. The factor 2 is for safety.
constexpr std::uint64_t kMaximumTexelsPerJpegByte = std::uint64_t{8} * 64 * 2;

struct Close {
    void operator()(void* decoder) const { tjDestroy(decoder); }
};
using Decoder = std::unique_ptr<void, Close>;

Decoder make_decoder(const std::string& file) {
    Decoder decoder(tjInitDecompress());
    if (!decoder)
        fail_system(file, fmt::format("no JPEG decoder ({:.80})", tjGetErrorStr2(nullptr)), "free some memory");
    return decoder;
}

void check(int status, const Decoder& decoder, const std::string& file) {
    if (status != 0)
        refuse_input(file, "", fmt::format("a broken JPEG ({:.80})", tjGetErrorStr2(decoder.get())), "a whole one",
                     "export the image again");
}

const unsigned char* data_of(std::span<const std::byte> bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

ByteImageSize size_of(std::span<const std::byte> bytes, const Decoder& decoder, const std::string& file) {
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colourspace = 0;
    check(tjDecompressHeader3(decoder.get(), data_of(bytes), bytes.size(), &width, &height, &subsampling, &colourspace),
          decoder, file);
    check_image_size(width, height, file, "");
    check_compression(width, height, bytes.size(), kMaximumTexelsPerJpegByte, file);
    // RGBA, and for progressive files the 16-bit coefficients of three channels, all of which are in memory at once.
    const std::uint64_t texels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
    check_decoded_bytes(width, height, (4 + 3 * 2) * texels, bytes.size(), file);
    return {width, height};
}

ByteImageSize jpeg_size(std::span<const std::byte> bytes, const std::string& file) {
    return size_of(bytes, make_decoder(file), file);
}

ByteImage decode_jpeg(std::span<const std::byte> bytes, const std::string& file) {
    const Decoder decoder = make_decoder(file);
    const ByteImageSize size = size_of(bytes, decoder, file);
    ByteImage result{size.width, size.height, {}};
    result.rgba.resize(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 4);
    // The library warns of damage and then invents texels. A progressive file can have any number of scans of a few
    // bytes each, and each scan costs as much as decoding the image.
    constexpr int kFlags = TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING | TJFLAG_LIMITSCANS;
    check(tjDecompress2(decoder.get(), data_of(bytes), bytes.size(), result.rgba.data(), size.width, 0, size.height,
                        TJPF_RGBA, kFlags),
          decoder, file);
    return result;
}

[[noreturn]] void refuse_format(std::span<const std::byte> bytes, const std::string& file) {
    refuse_input(file, "", bytes.empty() ? "an empty image" : "an unknown image format", "PNG or JPEG",
                 "convert the image to one of them");
}

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
    return bytes.size() >= kSignature.size() &&
           std::equal(kSignature.begin(), kSignature.end(), bytes.begin(),
                      [](std::uint8_t a, std::byte b) { return std::byte{a} == b; });
}

bool is_jpeg(std::span<const std::byte> bytes) {
    return bytes.size() >= 3 && bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8} &&
           bytes[2] == std::byte{0xFF};
}

ByteImageSize byte_image_size(std::span<const std::byte> bytes, const std::string& file) {
    if (is_png(bytes)) return png_size(bytes, file);
    if (is_jpeg(bytes)) return jpeg_size(bytes, file);
    refuse_format(bytes, file);
}

ByteImage decode_byte_image(std::span<const std::byte> bytes, const std::string& file) {
    if (is_png(bytes)) return decode_png(bytes, file);
    if (is_jpeg(bytes)) return decode_jpeg(bytes, file);
    refuse_format(bytes, file);
}

namespace {

void append(void* bytes, void* data, int size) {
    const auto* begin = static_cast<const std::byte*>(data);
    static_cast<std::vector<std::byte>*>(bytes)->insert(static_cast<std::vector<std::byte>*>(bytes)->end(), begin,
                                                        begin + size);
}

}  // namespace

std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels) {
    ROWLAND_CHECK_OP(width, >=, 1);
    ROWLAND_CHECK_OP(height, >=, 1);
    ROWLAND_CHECK(channels == 3 || channels == 4, "a PNG is written from RGB or RGBA");
    ROWLAND_CHECK_OP(
        pixels.size(), ==,
        static_cast<std::size_t>(channels) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<std::byte> bytes;
    if (stbi_write_png_to_func(append, &bytes, width, height, channels, pixels.data(), channels * width) == 0)
        fail_system({}, "encoding PNG failed", "free some memory");
    return bytes;
}

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
    write_file_atomic(path, encode_png(width, height, 3, rgb));
}

}  // namespace rowland::image

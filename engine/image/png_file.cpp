#include "engine/image/png_file.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <string_view>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/image/image.h"

// Format: Portable Network Graphics Specification, W3C 2003.

namespace rowland::image {

namespace {

constexpr std::array<std::uint8_t, 8> kSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
constexpr std::size_t kChunkFrame = 12;  ///< a chunk's length, type and checksum
constexpr std::size_t kHeaderLength = 13;
constexpr std::size_t kBitDepth = 8;  ///< position of the bits per channel in the header
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

Chunk header_of(std::span<const std::byte> bytes, const std::string& file) {
    const Chunk header = chunk_at(bytes, kSignature.size(), file);
    if (header.type != "IHDR" || header.data.size() != kHeaderLength)
        fail(file, kSignature.size(), "no PNG header", "an IHDR chunk");
    return header;
}

/// The file with only the chunks that hold the image: without gamma and profiles, which would be checked, and without
/// texts, which libpng would inflate.
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

/// What libpng's call-backs share with the functions that call it. libpng leaves by longjmp where it fails, so those
/// functions hold nothing that a destructor must free.
struct Coding {
    png_structp png = nullptr;
    png_infop info = nullptr;
    std::span<const std::byte> left{};  ///< of the file that is read
    std::vector<std::byte> written{};
    bool out_of_memory = false;
    std::array<char, 80> message{};

    Coding() = default;
    Coding(const Coding&) = delete;
    Coding& operator=(const Coding&) = delete;
};

[[noreturn]] void leave(png_structp png, png_const_charp text) {
    auto* coding = static_cast<Coding*>(png_get_error_ptr(png));
    std::strncpy(coding->message.data(), text, coding->message.size() - 1);
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

void read_bytes(png_structp png, png_bytep to, std::size_t count) {
    auto* coding = static_cast<Coding*>(png_get_io_ptr(png));
    if (count > coding->left.size()) png_error(png, "it ends too early");
    std::memcpy(to, coding->left.data(), count);
    coding->left = coding->left.subspan(count);
}

void write_bytes(png_structp png, png_bytep from, std::size_t count) {
    auto* coding = static_cast<Coding*>(png_get_io_ptr(png));
    const auto* bytes = reinterpret_cast<const std::byte*>(from);
    try {
        coding->written.insert(coding->written.end(), bytes, bytes + count);
    } catch (const std::bad_alloc&) {
        coding->out_of_memory = true;
    }
    if (coding->out_of_memory) png_error(png, "out of memory");
}

void flush_nothing(png_structp) {}

struct Reading : Coding {
    explicit Reading(std::span<const std::byte> bytes) {
        left = bytes;
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, static_cast<Coding*>(this), leave, ignore_warning);
        if (png) info = png_create_info_struct(png);
    }
    ~Reading() { png_destroy_read_struct(&png, &info, nullptr); }
};

struct Writing : Coding {
    Writing() {
        png = png_create_write_struct(PNG_LIBPNG_VER_STRING, static_cast<Coding*>(this), leave, ignore_warning);
        if (png) info = png_create_info_struct(png);
    }
    ~Writing() { png_destroy_write_struct(&png, &info); }
};

/// Reads all rows as RGBA, of 16 bits if `wide`, whose file then has as many, else of 8.
bool read_rgba(Coding& coding, bool wide, std::byte* texels, std::size_t row_bytes) {
    if (!coding.info || setjmp(png_jmpbuf(coding.png)) != 0) return false;
    png_set_benign_errors(coding.png, 1);
    png_set_read_fn(coding.png, &coding, read_bytes);
    png_read_info(coding.png, coding.info);
    png_set_expand(coding.png);
    png_set_gray_to_rgb(coding.png);
    if (wide) {
        if (std::endian::native == std::endian::little) png_set_swap(coding.png);
    } else {
        png_set_scale_16(coding.png);
    }
    png_set_add_alpha(coding.png, wide ? 0xFFFFU : 0xFFU, PNG_FILLER_AFTER);
    const int passes = png_set_interlace_handling(coding.png);
    png_read_update_info(coding.png, coding.info);
    if (png_get_rowbytes(coding.png, coding.info) != row_bytes) png_error(coding.png, "rows of another length");
    const png_uint_32 rows = png_get_image_height(coding.png, coding.info);
    for (int pass = 0; pass < passes; ++pass)
        for (png_uint_32 row = 0; row < rows; ++row)
            png_read_row(coding.png, reinterpret_cast<png_bytep>(texels + row * row_bytes), nullptr);
    png_read_end(coding.png, nullptr);
    return true;
}

struct Layout {
    int width;
    int height;
    int channels;
    int bits;
    PngEffort effort;
};

bool write_rows(Coding& coding, const Layout& layout, const std::byte* pixels) {
    if (!coding.info || setjmp(png_jmpbuf(coding.png)) != 0) return false;
    png_set_write_fn(coding.png, &coding, write_bytes, flush_nothing);
    if (layout.effort == PngEffort::Fast) {
        png_set_compression_level(coding.png, 1);
        png_set_filter(coding.png, 0, PNG_FILTER_SUB);
    }
    png_set_IHDR(coding.png, coding.info, static_cast<png_uint_32>(layout.width),
                 static_cast<png_uint_32>(layout.height), layout.bits,
                 layout.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(coding.png, coding.info);
    if (layout.bits == 16 && std::endian::native == std::endian::little) png_set_swap(coding.png);
    const std::size_t row_bytes = static_cast<std::size_t>(layout.width) * static_cast<std::size_t>(layout.channels) *
                                  static_cast<std::size_t>(layout.bits / 8);
    for (int row = 0; row < layout.height; ++row)
        png_write_row(coding.png,
                      reinterpret_cast<png_const_bytep>(pixels + static_cast<std::size_t>(row) * row_bytes));
    png_write_end(coding.png, nullptr);
    return true;
}

template <typename Value>
std::vector<std::byte> encode(int width, int height, int channels, std::span<const Value> pixels, PngEffort effort) {
    ROWLAND_CHECK_OP(width, >=, 1);
    ROWLAND_CHECK_OP(height, >=, 1);
    ROWLAND_CHECK(channels == 3 || channels == 4, "a PNG is written from RGB or RGBA");
    ROWLAND_CHECK_OP(
        pixels.size(), ==,
        static_cast<std::size_t>(channels) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    Writing writing;
    const Layout layout{width, height, channels, 8 * static_cast<int>(sizeof(Value)), effort};
    if (!write_rows(writing, layout, std::as_bytes(pixels).data()))
        fail_system({}, fmt::format("encoding PNG failed ({})", writing.message.data()), "free some memory");
    return std::move(writing.written);
}

}  // namespace

bool is_png(std::span<const std::byte> bytes) {
    return bytes.size() >= kSignature.size() &&
           std::equal(kSignature.begin(), kSignature.end(), bytes.begin(),
                      [](std::uint8_t a, std::byte b) { return std::byte{a} == b; });
}

ByteImageSize png_size(std::span<const std::byte> bytes, const std::string& file) {
    const Chunk header = header_of(bytes, file);
    const std::int64_t width = big_endian(header.data);
    const std::int64_t height = big_endian(header.data.subspan(4));
    check_image_size(width, height, file, fmt::format("byte {}", kSignature.size()));
    check_compression(width, height, bytes.size(), kMaximumTexelsPerPngByte, file);
    check_decoded_bytes(width, height, 4 * static_cast<std::uint64_t>(width * height), bytes.size(), file);
    return {static_cast<int>(width), static_cast<int>(height)};
}

ByteImage decode_png(std::span<const std::byte> bytes, const std::string& file, Depth depth) {
    const ByteImageSize size = png_size(bytes, file);
    const std::vector<std::byte> picture = picture_chunks(bytes, file);
    const bool wide = depth == Depth::OfFile && header_of(bytes, file).data[kBitDepth] == std::byte{16};
    const std::size_t row = 4 * static_cast<std::size_t>(size.width);
    const std::size_t values = row * static_cast<std::size_t>(size.height);
    if (wide) check_decoded_bytes(size.width, size.height, 3 * std::uint64_t{values}, bytes.size(), file);
    ByteImage result{size.width, size.height, std::vector<std::uint8_t>(values)};
    if (wide) result.rgba16.resize(values);
    Reading reading(picture);
    const std::span<std::byte> texels =
        wide ? std::as_writable_bytes(std::span(result.rgba16)) : std::as_writable_bytes(std::span(result.rgba));
    if (!read_rgba(reading, wide, texels.data(), wide ? 2 * row : row))
        refuse_input(file, "", fmt::format("a broken PNG ({:.60})", reading.message.data()), "a whole one",
                     "export the image again");
    // libpng's own rounding, so that the 8 bits do not depend on whether 16 were asked for.
    std::transform(result.rgba16.begin(), result.rgba16.end(), result.rgba.begin(),
                   [](std::uint16_t value) { return static_cast<std::uint8_t>((value * 255U + 32895U) >> 16U); });
    return result;
}

std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                  PngEffort effort) {
    return encode(width, height, channels, pixels, effort);
}

std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint16_t> pixels,
                                  PngEffort effort) {
    return encode(width, height, channels, pixels, effort);
}

}  // namespace rowland::image

#include "engine/image/byte_image.h"

#include <fmt/format.h>
#include <turbojpeg.h>

#include <cstddef>
#include <memory>
#include <vector>

#include "engine/core/error.h"
#include "engine/core/file.h"
#include "engine/image/image.h"
#include "engine/image/png_file.h"

namespace rowland::image {

namespace {

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

/// Inks of a press are no colours of a display without a profile, which is not read here.
void check_colours(int colourspace, const std::string& file) {
    if (colourspace == TJCS_CMYK || colourspace == TJCS_YCCK)
        refuse_input(file, "", "a JPEG in CMYK", "RGB or grey", "convert the image to sRGB");
}

const unsigned char* data_of(std::span<const std::byte> bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// As turbojpeg counts bytes: in 32 bits on Windows, which kMaximumFileBytes fits.
unsigned long byte_count(std::span<const std::byte> bytes) {
    return static_cast<unsigned long>(bytes.size());
}

ByteImageSize size_of(std::span<const std::byte> bytes, const Decoder& decoder, const std::string& file) {
    int width = 0;
    int height = 0;
    int subsampling = 0;
    int colourspace = 0;
    check(tjDecompressHeader3(decoder.get(), data_of(bytes), byte_count(bytes), &width, &height, &subsampling,
                              &colourspace),
          decoder, file);
    check_colours(colourspace, file);
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
    check(tjDecompress2(decoder.get(), data_of(bytes), byte_count(bytes), result.rgba.data(), size.width, 0, size.height,
                        TJPF_RGBA, kFlags),
          decoder, file);
    return result;
}

[[noreturn]] void refuse_format(std::span<const std::byte> bytes, const std::string& file) {
    refuse_input(file, "", bytes.empty() ? "an empty image" : "an unknown image format", "PNG or JPEG",
                 "convert the image to one of them");
}

}  // namespace

bool is_jpeg(std::span<const std::byte> bytes) {
    return bytes.size() >= 3 && bytes[0] == std::byte{0xFF} && bytes[1] == std::byte{0xD8} &&
           bytes[2] == std::byte{0xFF};
}

ByteImageSize byte_image_size(std::span<const std::byte> bytes, const std::string& file) {
    if (is_png(bytes)) return png_size(bytes, file);
    if (is_jpeg(bytes)) return jpeg_size(bytes, file);
    refuse_format(bytes, file);
}

ByteImage decode_byte_image(std::span<const std::byte> bytes, const std::string& file, Depth depth) {
    if (is_png(bytes)) return decode_png(bytes, file, depth);
    if (is_jpeg(bytes)) return decode_jpeg(bytes, file);
    refuse_format(bytes, file);
}

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
    write_file_atomic(path, encode_png(width, height, 3, rgb));
}

}  // namespace rowland::image

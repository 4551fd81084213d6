#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace rowland::image {

/// 8-bit RGBA picture, row 0 at the top, straight alpha. The values are as the file holds them, normally sRGB-encoded.
struct ByteImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< width·height·4, row by row
    /// The same values in 16 bits, where the file has so many and Depth::OfFile asked for them; else empty.
    std::vector<std::uint16_t> rgba16 = {};

    /// The value at an index of `rgba`, in [0, 1], as exact as the picture holds it.
    double value(std::size_t index) const { return rgba16.empty() ? rgba[index] / 255.0 : rgba16[index] / 65535.0; }
};

/// What decoding keeps of a picture of 16 bits.
enum class Depth {
    Bytes,  ///< its values rounded to 8 bits
    OfFile  ///< ByteImage::rgba16 as well, for data such as a groove texture
};

struct ByteImageSize {
    int width = 0;
    int height = 0;
};

/// The size in a PNG's or JPEG's header. Throws Error (input) for other bytes and above the limits of image/image.h.
ByteImageSize byte_image_size(std::span<const std::byte> bytes, const std::string& file);

/// Decodes a PNG or a JPEG, recognised by the first bytes. Grey and palette become RGB, missing alpha 255; `depth` says
/// what becomes of 16 bits. Colour profiles and gamma are ignored, as glTF 2.0, 3.8.3 requires. `file` names the bytes
/// in messages. Throws Error (input) for damaged and truncated pictures, for JPEGs in CMYK, and for those above the
/// limits of image/image.h before anything is allocated for them.
ByteImage decode_byte_image(std::span<const std::byte> bytes, const std::string& file, Depth depth = Depth::Bytes);

/// True if the bytes begin as a PNG or a JPEG does.
bool is_png(std::span<const std::byte> bytes);
bool is_jpeg(std::span<const std::byte> bytes);

/// How much time a PNG's compression takes.
enum class PngEffort {
    Small,  ///< zlib's default level, and the filter that suits each row
    Fast    ///< zlib's lowest level and one filter: about five times as fast
};

/// A PNG of `channels` 3 (RGB) or 4 (RGBA, straight alpha) with the 8 or 16 bits of its values, width·height·channels
/// of them, row by row from the top. The same picture gives the same bytes. Throws Error (system) if encoding fails.
std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels,
                                  PngEffort effort = PngEffort::Small);
std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint16_t> pixels,
                                  PngEffort effort = PngEffort::Small);

/// Writes an 8-bit RGB image (width·height·3 bytes, row by row from the top), atomically. Values are not encoded for
/// the display here. Throws Error (system) if writing fails.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace rowland::image

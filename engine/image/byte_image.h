#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace rowland::image {

/// 8-bit RGBA picture, row 0 at the top, straight alpha. The values are as the file holds them, normally sRGB-encoded.
struct ByteImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< width·height·4, row by row
};

struct ByteImageSize {
    int width = 0;
    int height = 0;
};

/// The size in a PNG's or JPEG's header. Throws Error (input), also above the limits of image/limits.h.
ByteImageSize byte_image_size(std::span<const std::byte> bytes, const std::string& file);

/// Decodes a PNG or a JPEG, whichever the first bytes say. Grey and palette become RGB, missing alpha 255, 16 bits 8.
/// Colour profiles and gamma are ignored, as glTF 2.0, 3.8.3 requires. `file` names the bytes in messages. Throws Error
/// (input), also for pictures above the limits of image/limits.h, before anything is allocated for them, and for cut
/// ones.
ByteImage decode_byte_image(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

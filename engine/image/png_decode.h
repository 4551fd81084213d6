#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "engine/image/byte_image.h"

namespace rowland::image {

bool is_png(std::span<const std::byte> bytes);

/// See byte_image_size and decode_byte_image; `bytes` must be a PNG's.
ByteImageSize png_size(std::span<const std::byte> bytes, const std::string& file);
ByteImage decode_png(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

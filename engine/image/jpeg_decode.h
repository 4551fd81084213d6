#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "engine/image/byte_image.h"

namespace rowland::image {

bool is_jpeg(std::span<const std::byte> bytes);

/// See byte_image_size and decode_byte_image; `bytes` must be a JPEG's.
ByteImageSize jpeg_size(std::span<const std::byte> bytes, const std::string& file);
ByteImage decode_jpeg(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

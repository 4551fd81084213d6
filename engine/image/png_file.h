#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "engine/image/byte_image.h"

namespace rowland::image {

/// The PNG part of byte_image_size() and decode_byte_image(). They throw as those do.
ByteImageSize png_size(std::span<const std::byte> bytes, const std::string& file);
ByteImage decode_png(std::span<const std::byte> bytes, const std::string& file, Depth depth);

}  // namespace rowland::image

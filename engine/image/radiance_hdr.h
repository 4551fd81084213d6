#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "engine/image/image.h"

namespace rowland::image {

/// Decodes a Radiance picture (.hdr, .pic): both run-length encodings and flat scanlines, all eight orientations.
/// A texel is mantissa · 2^(exponent − 136), 0 where the exponent is 0 (Radiance itself adds ½ to the mantissa; other
/// programs, and the reference radiances of the tests, do not); values are divided by the header's EXPOSURE and
/// COLORCORR lines and converted from its PRIMARIES, if any, to Rec.709. Throws Error (input) for anything malformed
/// and for sizes over image.h (checked before allocating); `file` names the bytes in messages.
Image read_radiance_hdr(std::span<const std::byte> bytes, const std::string& file);
Image read_radiance_hdr(const std::filesystem::path& path);

/// True if the bytes begin as a Radiance picture does.
bool is_radiance_hdr(std::span<const std::byte> bytes);

}  // namespace rowland::image

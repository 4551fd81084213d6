#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "engine/image/image.h"

namespace rowland::image {

/// Reads a Radiance or OpenEXR image, whichever the first bytes say. Throws Error (input).
Image load_image(const std::filesystem::path& path);
/// The same for bytes in memory; `file` names them in messages.
Image decode_image(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

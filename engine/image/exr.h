#pragma once

#include <cstddef>
#include <filesystem>
#include <glm/vec4.hpp>
#include <span>
#include <string>

#include "engine/image/image.h"

namespace rowland::image {

/// Decodes the first part of an OpenEXR file: half or float R, G, B (of the unnamed layer, else of the first layer that
/// has them), CIE X, Y, Z, or Y alone; scanlines or tiles, any compression OpenEXR knows. Alpha is ignored. X, Y, Z and
/// chromaticities other than Rec.709's are converted to it. Throws Error (input) for anything else: deep data,
/// luminance/chroma, subsampled or integer channels, cube maps, a data window that is not the display window, and sizes
/// over limits.h (checked before allocating).
Image read_exr(std::span<const std::byte> bytes, const std::string& file);
Image read_exr(const std::filesystem::path& path);

/// True if the bytes begin as an OpenEXR file does.
bool is_exr(std::span<const std::byte> bytes);

/// Writes 32-bit float RGB or RGBA (width·height texels, row by row from the top), ZIP-compressed, atomically. The same
/// texels give the same bytes. Throws Error (system) if writing fails.
void write_exr(const std::filesystem::path& path, const Image& image);
void write_exr(const std::filesystem::path& path, int width, int height, std::span<const glm::vec4> texels);

}  // namespace rowland::image

#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace rowland::image {

/// Writes an 8-bit RGB image (width·height·3 bytes, row by row from the top), atomically. The bytes are written as they
/// are: encode for the display first. Throws Error (system) if writing fails.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace rowland::image

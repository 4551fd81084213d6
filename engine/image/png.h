#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace rowland::image {

/// An 8-bit PNG of `channels` 3 (RGB) or 4 (RGBA, straight alpha), width·height·channels bytes, row by row from the
/// top. The same picture gives the same bytes. Throws Error (system) if encoding fails.
std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels);

/// Writes an 8-bit RGB image (width·height·3 bytes, row by row from the top), atomically. Values are not encoded for
/// the display here. Throws Error (system) if writing fails.
void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace rowland::image

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "engine/image/image.h"

namespace rowland::image {

/// Decodes the first part of an OpenEXR file: half or float R, G, B (of the unnamed layer, else of the first layer that
/// has them), CIE X, Y, Z, or Y alone; scanlines or tiles, any compression OpenEXR knows. Alpha is ignored. X, Y, Z and
/// RGB of other chromaticities are converted to Rec.709. Throws Error (input) for anything else: deep data,
/// luminance/chroma, subsampled or integer channels, cube maps, a data window that is not the display window, and sizes
/// over the limits of image.h (checked before allocating).
Image read_exr(std::span<const std::byte> bytes, const std::string& file);

/// True if the bytes begin as an OpenEXR file does.
bool is_exr(std::span<const std::byte> bytes);

/// Writes 32-bit float RGB, ZIP-compressed, atomically. The same texels give the same bytes. Throws Error (system) if
/// writing fails.
void write_exr(const std::filesystem::path& path, const Image& image);

/// Checks the headers of all parts of an OpenEXR file before OpenEXR reads them. Throws Error (input) naming `file` and
/// the byte where the library would allocate more than the file can hold: attributes longer than the file, images over
/// the limits of image.h, offset tables that do not fit, oversized tiles and chunks, too many channels or parts. Deep
/// data is refused as well.
void check_exr_header(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

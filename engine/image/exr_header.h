#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rowland::image {

/// Walks the headers of all parts of an OpenEXR file before OpenEXR sees it, and throws Error (input) naming `file` and
/// the byte for whatever would make the library allocate more than the file can hold: attributes longer than the file,
/// images over limits.h, offset tables that do not fit, oversized tiles and chunks, too many channels or parts; and for
/// deep data, which is no image.
void check_exr_header(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

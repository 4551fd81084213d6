#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace rowland::image {

/// Checks the headers of all parts of an OpenEXR file before OpenEXR reads them. Throws Error (input) naming `file` and
/// the byte where the library would allocate more than the file can hold: attributes longer than the file, images over
/// limits.h, offset tables that do not fit, oversized tiles and chunks, too many channels or parts. Deep data is
/// refused as well.
void check_exr_header(std::span<const std::byte> bytes, const std::string& file);

}  // namespace rowland::image

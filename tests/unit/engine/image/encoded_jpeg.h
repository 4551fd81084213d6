#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace rowland::test {

/// A JPEG of best quality without chroma subsampling; `rgb` has width·height·3 bytes.
std::vector<std::byte> encoded_jpeg(int width, int height, std::span<const std::uint8_t> rgb);

}  // namespace rowland::test

#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::test {

inline std::span<const std::byte> as_bytes(std::string_view text) {
    return std::as_bytes(std::span(text.data(), text.size()));
}

/// A JPEG of best quality without chroma subsampling; `rgb` has width·height·3 bytes.
std::vector<std::byte> encoded_jpeg(int width, int height, std::span<const std::uint8_t> rgb);
/// The same of inks; `cmyk` has width·height·4 bytes.
std::vector<std::byte> encoded_cmyk_jpeg(int width, int height, std::span<const std::uint8_t> cmyk);

}  // namespace rowland::test

#include "engine/image/png.h"

#include <stb_image_write.h>

#include <cstddef>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

namespace rowland::image {

namespace {

void append(void* bytes, void* data, int size) {
    const auto* begin = static_cast<const std::byte*>(data);
    static_cast<std::vector<std::byte>*>(bytes)->insert(static_cast<std::vector<std::byte>*>(bytes)->end(), begin,
                                                        begin + size);
}

}  // namespace

std::vector<std::byte> encode_png(int width, int height, int channels, std::span<const std::uint8_t> pixels) {
    ROWLAND_CHECK_OP(width, >=, 1);
    ROWLAND_CHECK_OP(height, >=, 1);
    ROWLAND_CHECK(channels == 3 || channels == 4, "a PNG is written from RGB or RGBA");
    ROWLAND_CHECK_OP(
        pixels.size(), ==,
        static_cast<std::size_t>(channels) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<std::byte> bytes;
    if (stbi_write_png_to_func(append, &bytes, width, height, channels, pixels.data(), channels * width) == 0)
        fail_system({}, "encoding PNG failed", "free some memory");
    return bytes;
}

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
    write_file_atomic(path, encode_png(width, height, 3, rgb));
}

}  // namespace rowland::image

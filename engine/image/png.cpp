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

void write_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint8_t> rgb) {
    ROWLAND_CHECK_OP(width, >=, 1);
    ROWLAND_CHECK_OP(height, >=, 1);
    ROWLAND_CHECK_OP(rgb.size(), ==,
                     std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<std::byte> bytes;
    if (stbi_write_png_to_func(append, &bytes, width, height, 3, rgb.data(), 3 * width) == 0)
        throw Error({.file = path.string(),
                     .place = {},
                     .found = "encoding PNG failed",
                     .expected = {},
                     .remedy = "free some memory",
                     .fault = Fault::System});
    write_file_atomic(path, bytes);
}

}  // namespace rowland::image

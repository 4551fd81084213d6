#include "modules/diffraction/asset/height_map_png.h"

#include <fmt/format.h>

#include <span>
#include <vector>

#include "engine/core/error.h"
#include "engine/image/png.h"
#include "engine/image/png_decode.h"

namespace rowland::diffraction {

HeightMap read_height_map(const NamedText& png) {
    const std::span<const std::byte> bytes = std::as_bytes(std::span(png.text));
    if (!image::is_png(bytes)) refuse_input(png.file, {}, "another format", "a PNG of the heights of one cell");
    const image::ByteImageSize size = image::png_size(bytes, png.file);
    if (size.width > kLargestHeightMap || size.height > kLargestHeightMap)
        refuse_input(png.file, {}, fmt::format("{} x {} texels", size.width, size.height),
                     fmt::format("at most {0} x {0} for the heights of one cell", kLargestHeightMap),
                     "scale the picture down");
    const image::ByteImage picture = image::decode_png(bytes, png.file);
    HeightMap map{.columns = picture.width, .rows = picture.height, .heights = {}, .depth_nm = 0.0};
    for (std::size_t texel = 0; texel < picture.rgba.size(); texel += 4) map.heights.push_back(picture.rgba[texel]);
    return map;
}

std::string write_height_map(const HeightMap& map) {
    std::vector<std::uint8_t> rgb;
    for (const std::uint8_t height : map.heights) rgb.insert(rgb.end(), 3, height);
    const std::vector<std::byte> png = image::encode_png(map.columns, map.rows, 3, rgb);
    return {reinterpret_cast<const char*>(png.data()), png.size()};
}

}  // namespace rowland::diffraction

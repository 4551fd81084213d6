#include "engine/image/limits.h"

#include <fmt/format.h>

#include "engine/core/error.h"

namespace rowland::image {

void check_image_size(std::int64_t width, std::int64_t height, const std::string& file, const std::string& place) {
    const bool sides_fit = width >= 1 && height >= 1 && width <= kMaximumSide && height <= kMaximumSide;
    if (sides_fit && static_cast<std::uint64_t>(width * height) <= kMaximumTexels) return;
    throw Error({.file = file,
                 .place = place,
                 .found = fmt::format("an image of {} x {} texels", width, height),
                 .expected = fmt::format("sides in [1, {}] and at most {} texels", kMaximumSide, kMaximumTexels),
                 .remedy = "scale the image down"});
}

void check_compression(std::int64_t width, std::int64_t height, std::size_t length, std::uint64_t texels_per_byte,
                       const std::string& file) {
    if (static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) / texels_per_byte <= length) return;
    refuse_input(file, "", fmt::format("an image of {} x {} texels in {} bytes", width, height, length),
                 "the whole image", "export the image again");
}

}  // namespace rowland::image

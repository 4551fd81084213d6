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

}  // namespace rowland::image

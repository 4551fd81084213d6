// The levels of a groove texture whose facets sparkle.
#include <cstdlib>
#include <glm/common.hpp>

#include "content/web/bake/exports.h"
#include "modules/diffraction/asset/groove_pitches.h"
#include "modules/diffraction/runtime/groove_moments.h"

namespace rowland::web {

/// The smallest and the largest pitch, whether there are gaps, the mean texels of a facet, and the moments of all
/// levels, the largest first, in [0, 1]. `texels`: RGBA of `bytes` each, got from room(), which are released.
ROWLAND_EXPORT(facet_levels)
Numbers* facet_levels(std::uint8_t* texels, int width, int height, int bytes, int even) {
    using namespace diffraction;
    image::ByteImage image{width, height, {}};
    const std::size_t count = 4 * static_cast<std::size_t>(width * height);
    if (bytes == 1) {
        image.rgba.assign(texels, texels + count);
    } else {
        const auto* values = reinterpret_cast<const std::uint16_t*>(texels);
        image.rgba16.assign(values, values + count);
        image.rgba.resize(count);  // its size is the image's
    }
    std::free(texels);
    const GroovePitches pitches = groove_pitches(image);
    bool gaps = false;
    for (std::size_t i = 1; i < count; i += 4) gaps = gaps || image.value(i) == 0.0;
    auto* numbers = new Numbers{static_cast<float>(pitches.smallest), static_cast<float>(pitches.largest),
                                static_cast<float>(gaps ? 1 : 0), static_cast<float>(facet_texels(image))};
    std::vector<std::uint16_t> moments =
        groove_moments(image, {.even = even != 0, .gaps = gaps, .smallest_pitch = pitches.smallest});
    numbers->reserve(numbers->size() + count + count / 2);  // the levels below are a third of the first
    for (glm::ivec2 size(width, height);; size = glm::max(size / 2, 1)) {
        for (const std::uint16_t moment : moments) append(static_cast<float>(moment) / 65535.0F, *numbers);
        if (size == glm::ivec2(1)) return numbers;
        moments = facets_of_level(moments, size, gaps);
    }
}

}  // namespace rowland::web

#include "engine/post/dither.h"

#include "engine/core/check.h"

namespace rowland::post {

float dither_offset(glm::ivec2 pixel, std::uint32_t frame) {
    // 2^32 over the plastic number 1.32471795724, over its square, and over the golden ratio.
    const std::uint32_t phase = static_cast<std::uint32_t>(pixel.x) * 0xc13fa9a9U +
                                static_cast<std::uint32_t>(pixel.y) * 0x91e10da5U + frame * 0x9e3779b9U;
    // Ten bits: float sums of a display value and its noise keep them.
    return (static_cast<float>(phase >> 22U) + 0.5F) / 1024.0F - 0.5F;
}

void apply_dither(std::span<glm::vec3> pixels, glm::ivec2 size, std::uint32_t frame, const DitherSettings& settings) {
    ROWLAND_CHECK_OP(pixels.size(), ==, static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const float step = dither_step(settings);
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) pixels[i++] += step * dither_offset({x, y}, frame);
    }
}

float dither_step(const DitherSettings& settings) {
    ROWLAND_CHECK_OP(settings.bits, >=, 1);
    ROWLAND_CHECK_OP(settings.bits, <=, 12);
    return 1.0F / static_cast<float>((1 << settings.bits) - 1);
}

}  // namespace rowland::post

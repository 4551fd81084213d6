#include "modules/diffraction/runtime/groove_moments.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rowland::diffraction {

namespace {

std::uint16_t normalised(double value) {
    return static_cast<std::uint16_t>(std::lround(65535.0 * value));
}

std::array<std::uint16_t, 4> moments_of(std::uint8_t red, std::uint8_t green, const GrooveMomentUse& use) {
    if (green == 0) return {normalised(0.5), normalised(0.5), 0, 0};
    const double angle = (use.even ? 2.0 : 1.0) * std::numbers::pi * red / 255.0;
    const double inverse = use.smallest_pitch / (2.0 * green / 255.0);
    return {normalised(0.5 + 0.5 * std::cos(angle)), normalised(0.5 + 0.5 * std::sin(angle)), normalised(inverse),
            normalised(use.gaps ? 1.0 : inverse * inverse)};
}

}  // namespace

std::vector<std::uint16_t> groove_moments(const image::ByteImage& image, const GrooveMomentUse& use) {
    std::vector<std::uint16_t> moments;
    moments.reserve(image.rgba.size());
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        for (const std::uint16_t moment : moments_of(image.rgba[i], image.rgba[i + 1], use)) moments.push_back(moment);
    return moments;
}

}  // namespace rowland::diffraction

#include "modules/diffraction/runtime/groove_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <numbers>
#include <random>

namespace rowland::diffraction {

namespace {

constexpr std::uint16_t kHalfMoment = 32768;  ///< of a texel without a grating

std::uint16_t normalised(double value) {
    return static_cast<std::uint16_t>(std::lround(65535.0 * value));
}

std::array<std::uint16_t, 4> moments_of(double red, double green, const GrooveMomentUse& use) {
    if (green == 0.0) return {normalised(0.5), normalised(0.5), 0, 0};
    const double angle = (use.even ? 2.0 : 1.0) * std::numbers::pi * red;
    const double inverse = std::min(use.smallest_pitch / (2.0 * green), 1.0);
    return {normalised(0.5 + 0.5 * std::cos(angle)), normalised(0.5 + 0.5 * std::sin(angle)), normalised(inverse),
            normalised(use.gaps ? 1.0 : inverse * inverse)};
}

}  // namespace

std::vector<std::uint16_t> groove_moments(const image::ByteImage& image, const GrooveMomentUse& use) {
    std::vector<std::uint16_t> moments;
    moments.reserve(image.rgba.size());
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
        for (const std::uint16_t moment : moments_of(image.value(i), image.value(i + 1), use))
            moments.push_back(moment);
    return moments;
}

double facet_texels(const image::ByteImage& image) {
    const auto texel = [&](int column, int row) {
        return 4 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                    static_cast<std::size_t>(column));
    };
    double area = 1.0;
    for (const bool along_rows : {true, false}) {
        std::size_t pairs = 0;
        std::size_t different = 0;
        for (int row = along_rows ? 0 : 1; row < image.height; ++row)
            for (int column = along_rows ? 1 : 0; column < image.width; ++column) {
                const std::size_t here = texel(column, row);
                const std::size_t before = along_rows ? texel(column - 1, row) : texel(column, row - 1);
                if (image.value(here + 1) == 0.0 || image.value(before + 1) == 0.0) continue;
                ++pairs;
                if (image.value(here) != image.value(before)) ++different;
            }
        area *= static_cast<double>(std::max<std::size_t>(pairs, 1)) /
                static_cast<double>(std::max<std::size_t>(different, 1));
    }
    return area;
}

std::vector<std::uint16_t> facets_of_level(const std::vector<std::uint16_t>& from, const glm::ivec2& size, bool gaps) {
    const glm::ivec2 half = glm::max(size / 2, 1);
    std::vector<std::uint16_t> to;
    to.reserve(4 * static_cast<std::size_t>(half.x) * static_cast<std::size_t>(half.y));
    std::minstd_rand random;  // the same numbers everywhere
    for (int row = 0; row < half.y; ++row)
        for (int column = 0; column < half.x; ++column) {
            std::array<const std::uint16_t*, 4> covered{};
            std::size_t count = 0;
            double coverage = 0.0;
            for (int i = 0; i < 4; ++i) {
                const int x = std::min(2 * column + i % 2, size.x - 1);
                const int y = std::min(2 * row + i / 2, size.y - 1);
                const std::uint16_t* texel = &from[4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) +
                                                        static_cast<std::size_t>(x))];
                if (texel[2] == 0) continue;
                covered.at(count++) = texel;
                coverage += gaps ? texel[3] / 4.0 : 0.25 * 65535.0;
            }
            if (count == 0) {
                to.insert(to.end(), {kHalfMoment, kHalfMoment, 0, 0});
                continue;
            }
            const std::uint16_t* chosen = covered.at(random() / 8U % count);  // the lowest bits are the least random
            const double ratio = gaps ? coverage / chosen[3] : 1.0;
            for (std::size_t c = 0; c < 4; ++c) {
                const double middle = c < 2 ? kHalfMoment : 0.0;
                const double scaled = c == 3 && !gaps ? chosen[3] : middle + ratio * (chosen[c] - middle);
                to.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(scaled, 0.0, 65535.0))));
            }
        }
    return to;
}

}  // namespace rowland::diffraction

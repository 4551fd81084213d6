#include "tests/unit/engine/post/cpu_effects.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

/// Light in rgb and area in alpha, both relative to those of a texel inside the picture.
struct Grid {
    glm::ivec2 size{0};
    std::vector<glm::vec4> texels;

    explicit Grid(glm::ivec2 grid_size)
        : size(grid_size), texels(static_cast<std::size_t>(grid_size.x) * static_cast<std::size_t>(grid_size.y)) {}

    glm::vec4& at(int x, int y) { return texels[index(x, y)]; }
    const glm::vec4& at(int x, int y) const { return texels[index(x, y)]; }
    glm::vec3 value(int x, int y) const { return glm::vec3(at(x, y)) / at(x, y).a; }

 private:
    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(size.x) + static_cast<std::size_t>(x);
    }
};

float usable(float value) {
    constexpr float largest_half = 65504.0F;
    return std::isfinite(value) ? std::clamp(value, -largest_half, largest_half) : 0.0F;
}

/// Where the centre of a fine texel lies among the centres of the coarse ones.
float coarse_position(int fine, int coarse_count) {
    const float position = 0.5F * (static_cast<float>(fine) + 0.5F) - 0.5F;
    return std::clamp(position, 0.0F, static_cast<float>(coarse_count - 1));
}

/// W(fine, coarse).
float weight(int fine, int coarse, int coarse_count) {
    return std::max(0.0F, 1.0F - std::abs(coarse_position(fine, coarse_count) - static_cast<float>(coarse)));
}

/// What reaches coarse texel (x, y). At most four by four fine texels have a weight there; light and area are divided
/// by 4, the area of a coarse texel inside.
glm::vec4 gathered(const Grid& fine, glm::ivec2 coarse_size, int x, int y) {
    glm::vec4 sum(0.0F);
    for (int fine_y = std::max(0, 2 * y - 1); fine_y <= std::min(2 * y + 2, fine.size.y - 1); ++fine_y) {
        for (int fine_x = std::max(0, 2 * x - 1); fine_x <= std::min(2 * x + 2, fine.size.x - 1); ++fine_x) {
            sum += weight(fine_x, x, coarse_size.x) * weight(fine_y, y, coarse_size.y) * fine.at(fine_x, fine_y);
        }
    }
    return 0.25F * sum;
}

Grid coarser(const Grid& fine, glm::ivec2 coarse_size) {
    Grid coarse(coarse_size);
    for (int y = 0; y < coarse_size.y; ++y) {
        for (int x = 0; x < coarse_size.x; ++x) coarse.at(x, y) = gathered(fine, coarse_size, x, y);
    }
    return coarse;
}

glm::vec3 interpolated(const Grid& coarse, int fine_x, int fine_y) {
    const glm::vec2 position(coarse_position(fine_x, coarse.size.x), coarse_position(fine_y, coarse.size.y));
    const glm::ivec2 low(position);
    const glm::ivec2 high = glm::min(low + 1, coarse.size - 1);
    const glm::vec2 weight = position - glm::vec2(low);
    const glm::vec3 lower = glm::mix(coarse.value(low.x, low.y), coarse.value(high.x, low.y), weight.x);
    const glm::vec3 upper = glm::mix(coarse.value(low.x, high.y), coarse.value(high.x, high.y), weight.x);
    return glm::mix(lower, upper, weight.y);
}

/// Mixes `fraction` of the coarser level into a finer one.
void mix_in(Grid& fine, const Grid& coarse, float fraction) {
    for (int y = 0; y < fine.size.y; ++y) {
        for (int x = 0; x < fine.size.x; ++x) {
            fine.at(x, y) = glm::vec4(glm::mix(fine.value(x, y), interpolated(coarse, x, y), fraction), 1.0F);
        }
    }
}

Grid as_grid(std::span<const glm::vec3> pixels, glm::ivec2 size) {
    Grid grid(size);
    std::transform(pixels.begin(), pixels.end(), grid.texels.begin(), [](const glm::vec3& pixel) {
        return glm::vec4(usable(pixel.r), usable(pixel.g), usable(pixel.b), 1.0F);
    });
    return grid;
}

/// cos⁴ of the angle whose tangent is given.
float cos4(float tangent) {
    const float squared_secant = 1.0F + tangent * tangent;
    return 1.0F / (squared_secant * squared_secant);
}

}  // namespace

void apply_bloom(std::span<glm::vec3> pixels, glm::ivec2 size, const BloomSettings& settings) {
    require_valid(settings);
    ROWLAND_CHECK_OP(pixels.size(), ==, static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    if (settings.strength == 0.0F || pixels.empty()) return;
    Grid picture = as_grid(pixels, size);
    std::vector<Grid> levels;
    for (const glm::ivec2 level_size : bloom_level_sizes(size, settings.levels)) {
        levels.push_back(coarser(levels.empty() ? picture : levels.back(), level_size));
    }
    for (std::size_t i = levels.size() - 1; i-- > 0;) {
        mix_in(levels[i], levels[i + 1], bloom_coarser_weight(i, levels.size()));
    }
    mix_in(picture, levels.front(), settings.strength);
    std::transform(picture.texels.begin(), picture.texels.end(), pixels.begin(),
                   [](const glm::vec4& texel) { return glm::vec3(texel); });
}

std::optional<double> mean_log2_luminance(std::span<const glm::vec3> pixels, const glm::vec3& weights, float darkest) {
    double sum = 0.0;
    double count = 0.0;
    for (const glm::vec3& pixel : pixels) {
        const float luminance = glm::dot(weights, pixel);
        if (!std::isfinite(luminance)) continue;
        sum += std::log2(static_cast<double>(std::max(luminance, darkest)));
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    return sum / count;
}

float dither_offset(glm::ivec2 pixel, std::uint32_t frame) {
    // 2^32 over the plastic number 1.32471795724, over its square, and over the golden ratio.
    const std::uint32_t phase = static_cast<std::uint32_t>(pixel.x) * 0xc13fa9a9U +
                                static_cast<std::uint32_t>(pixel.y) * 0x91e10da5U + frame * 0x9e3779b9U;
    // Ten bits: float sums of a display value and its noise keep them.
    return (static_cast<float>(phase >> 22U) + 0.5F) / 1024.0F - 0.5F;
}

namespace {

std::uint32_t hashed(std::uint32_t value) {
    const std::uint32_t state = value * 747796405U + 2891336453U;
    const std::uint32_t word = ((state >> ((state >> 28U) + 4U)) ^ state) * 277803737U;
    return (word >> 22U) ^ word;
}

}  // namespace

float grain_offset(glm::ivec2 pixel, std::uint32_t frame) {
    constexpr std::array kWeights{1, 2, 1};
    int sum = 0;
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 3; ++x) {
            const auto column = static_cast<std::uint32_t>(pixel.x + x);
            const auto row = static_cast<std::uint32_t>(pixel.y + y);
            std::uint32_t bits = hashed(column + hashed(row + hashed(frame)));
            int bytes = -510;
            for (int i = 0; i < 4; ++i, bits >>= 8U) bytes += static_cast<int>(bits & 255U);
            sum += kWeights[static_cast<std::size_t>(x)] * kWeights[static_cast<std::size_t>(y)] * bytes;
        }
    }
    const double byte_variance = (256.0 * 256.0 - 1.0) / 12.0;
    return static_cast<float>(sum / std::sqrt(36.0 * 4.0 * byte_variance));
}

void apply_grain(std::span<glm::vec3> pixels, glm::ivec2 size, std::uint32_t frame, const GrainSettings& settings) {
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x, ++i) {
            const float mean = (pixels[i].r + pixels[i].g + pixels[i].b) / 3.0F;
            pixels[i] += settings.strength * 2.0F * std::sqrt(mean * (1.0F - mean)) * grain_offset({x, y}, frame);
        }
    }
}

void apply_dither(std::span<glm::vec3> pixels, glm::ivec2 size, std::uint32_t frame, const DitherSettings& settings) {
    ROWLAND_CHECK_OP(pixels.size(), ==, static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    const float step = dither_step(settings);
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) pixels[i++] += step * dither_offset({x, y}, frame);
    }
}

float vignette_factor(glm::ivec2 pixel, glm::ivec2 size, const VignetteSettings& settings) {
    const glm::vec2 half_size = 0.5F * glm::vec2(size);
    const float distance = glm::length(glm::vec2(pixel) + 0.5F - half_size);
    const float radius = distance / glm::length(half_size);
    const float taste =
        1.0F - settings.strength * glm::smoothstep(settings.radius, settings.radius + settings.softness, radius);
    if (!settings.vertical_fov) return taste;
    return taste * cos4(std::tan(0.5F * *settings.vertical_fov) * distance / half_size.y);
}

void apply_vignette(std::span<glm::vec3> pixels, glm::ivec2 size, const VignetteSettings& settings) {
    require_valid(settings);
    ROWLAND_CHECK_OP(pixels.size(), ==, static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    std::size_t i = 0;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) pixels[i++] *= vignette_factor({x, y}, size, settings);
    }
}

void apply_exposure(std::span<glm::vec3> pixels, float stops) {
    for (glm::vec3& pixel : pixels) pixel *= std::exp2(stops);
}

}  // namespace rowland::post

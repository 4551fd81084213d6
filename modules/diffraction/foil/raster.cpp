#include "modules/diffraction/foil/raster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec4.hpp>

#include "engine/core/parallel.h"

namespace rowland::diffraction::foil {

namespace {

/// The source texels that a texel is a mean of.
struct Taps {
    int first = 0;
    std::vector<float> weights{};  ///< sum 1
};

/// Of the texels of an axis of `size`, onto which `source` texels are scaled after `cut` of them have been cut off
/// before the first.
std::vector<Taps> taps_of(int size, int source, double cut, double source_per_texel) {
    std::vector<Taps> all(static_cast<std::size_t>(size));
    const double reach = std::max(1.0, source_per_texel);
    for (int i = 0; i < size; ++i) {
        Taps& taps = all[static_cast<std::size_t>(i)];
        const double middle = cut + (i + 0.5) * source_per_texel - 0.5;
        const int begin = std::clamp(static_cast<int>(std::floor(middle - reach)) + 1, 0, source - 1);
        const int end = std::clamp(static_cast<int>(std::ceil(middle + reach)), begin + 1, source);
        taps.first = begin;
        double sum = 0.0;
        for (int k = begin; k < end; ++k) {
            const double weight = std::max(1.0 - std::abs(k - middle) / reach, 1e-9);
            taps.weights.push_back(static_cast<float>(weight));
            sum += weight;
        }
        for (float& weight : taps.weights) weight = static_cast<float>(weight / sum);
    }
    return all;
}

std::uint8_t byte_of(float value) {
    return static_cast<std::uint8_t>(std::clamp(value + 0.5F, 0.0F, 255.0F));
}

}  // namespace

image::ByteImage fill_card(const image::ByteImage& picture, int width, int height) {
    if (picture.width == width && picture.height == height) return picture;
    const double source_per_texel =
        std::min(static_cast<double>(picture.width) / width, static_cast<double>(picture.height) / height);
    const auto cut = [&](int source, int size) { return 0.5 * (source - size * source_per_texel); };
    const std::vector<Taps> columns = taps_of(width, picture.width, cut(picture.width, width), source_per_texel);
    const std::vector<Taps> rows = taps_of(height, picture.height, cut(picture.height, height), source_per_texel);
    image::ByteImage result{width, height, {}};
    result.rgba.resize(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    parallel_for(static_cast<std::size_t>(height), [&](std::size_t row) {
        // The mean of source rows, colours times alpha / 255.
        std::vector<glm::vec4> line(static_cast<std::size_t>(picture.width), glm::vec4(0.0F));
        for (std::size_t k = 0; k < rows[row].weights.size(); ++k) {
            const std::uint8_t* from = &picture.rgba[4 * static_cast<std::size_t>(picture.width) *
                                                     (static_cast<std::size_t>(rows[row].first) + k)];
            for (glm::vec4& sum : line) {
                const float weight = rows[row].weights[k] * static_cast<float>(from[3]) / 255.0F;
                sum += weight * glm::vec4(from[0], from[1], from[2], 255.0F);
                from += 4;
            }
        }
        std::uint8_t* to = &result.rgba[4 * row * static_cast<std::size_t>(width)];
        for (const Taps& taps : columns) {
            glm::vec4 sum(0.0F);
            for (std::size_t k = 0; k < taps.weights.size(); ++k)
                sum += taps.weights[k] * line[static_cast<std::size_t>(taps.first) + k];
            const float opacity = std::max(sum.a / 255.0F, 1e-6F);
            for (int c = 0; c < 3; ++c) *to++ = byte_of(sum[c] / opacity);
            *to++ = byte_of(sum.a);
        }
    });
    return result;
}

bool has_proportions(const image::ByteImageSize& picture, int width, int height) {
    const double scale =
        std::max(static_cast<double>(width) / picture.width, static_cast<double>(height) / picture.height);
    return picture.width * scale < width + 0.5 && picture.height * scale < height + 0.5;
}

Brightness brightness_of(const image::ByteImage& picture) {
    std::array<float, 256> linear{};  // sRGB, IEC 61966-2-1
    for (std::size_t i = 0; i < linear.size(); ++i) {
        const double x = static_cast<double>(i) / 255.0;
        linear[i] = static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
    }
    Brightness brightness(picture.rgba.size() / 4);
    for (std::size_t i = 0; i < brightness.size(); ++i) {
        const std::uint8_t* texel = &picture.rgba[4 * i];
        const float luminance = 0.2126F * linear[texel[0]] + 0.7152F * linear[texel[1]] + 0.0722F * linear[texel[2]];
        brightness[i] = luminance * static_cast<float>(texel[3]) / 255.0F;
    }
    return brightness;
}

}  // namespace rowland::diffraction::foil

#include "editor/trade/probe_statistics.h"

#include <algorithm>
#include <numbers>
#include <vector>

#include "engine/colour/working_space.h"

namespace rowland::trade {

namespace {

struct Texel {
    double luminance;
    double solid_angle;
};

/// The light of the brightest texels that fill a solid angle; the last one counts in part.
double brightest(const std::vector<Texel>& descending, double solid_angle) {
    double light = 0.0;
    for (const Texel& texel : descending) {
        const double counted = std::min(texel.solid_angle, solid_angle);
        light += counted * texel.luminance;
        solid_angle -= counted;
        if (solid_angle <= 0.0) break;
    }
    return light;
}

}  // namespace

ProbeStatistics statistics_of(const lighting::ProbeImage& probe) {
    constexpr double kSphere = 4.0 * std::numbers::pi;
    const image::Image& image = probe.image();
    std::vector<Texel> texels;
    double light = 0.0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                               static_cast<std::size_t>(column);
            const Texel texel{colour::luminance(image.texels[index]), probe.solid_angle(column, row)};
            if (texel.solid_angle <= 0.0) continue;
            texels.push_back(texel);
            light += texel.luminance * texel.solid_angle;
        }
    std::ranges::sort(texels, std::ranges::greater(), &Texel::luminance);
    ProbeStatistics result{.width = image.width, .height = image.height, .mean = light / kSphere};
    if (light <= 0.0) return result;
    result.peak_over_mean = texels.front().luminance / result.mean;
    result.brightest_fraction = brightest(texels, 1e-3 * kSphere) / light;
    return result;
}

}  // namespace rowland::trade

#include "modules/diffraction/representations/direct/pattern_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"
#include "modules/diffraction/representations/direct/lobe_table.h"

namespace rowland::diffraction {

namespace {

constexpr int kSmallestPicture = 128;
/// Of all lights' finest levels.
constexpr std::size_t kMostTexels = std::size_t{1} << 22;
/// Of the finest level's blur: finer texels change nothing that is measured against the reference.
constexpr double kTexelsPerDeviation = 1.6;

int picture_size(double half_width, std::span<const lighting::KeyLight> lights) {
    double narrowest = half_width;
    for (const lighting::KeyLight& light : lights)
        narrowest = std::min(narrowest, std::sqrt(lighting::lobe_moments(light.concentration).variance_across));
    const double texels = 2.0 * half_width * kTexelsPerDeviation / (std::sqrt(kPictureVariance) * narrowest);
    std::size_t size = kSmallestPicture;
    while (static_cast<double>(size) < texels && size < kPatternPictureSize &&
           4 * size * size * std::bit_ceil(lights.size()) <= kMostTexels)
        size *= 2;
    return static_cast<int>(size);
}

}  // namespace

PatternLight pattern_light(const DirectLight& light, const std::optional<Cover>& cover,
                           const glm::dmat3& world_to_tangent) {
    const LightSpot spot = light_spot(light, world_to_tangent);
    return {.irradiance = spot.cosine * transmittance(cover, spot) * light.flux,
            .centre = {spot.centre_g, spot.centre_h},
            .variance = 0.5 * (spot.deviation_g * spot.deviation_g + spot.deviation_h * spot.deviation_h)};
}

glm::dvec3 pattern_radiance(const PatternPicture& picture, const PatternLight& light, const glm::dvec2& v_p,
                            double footprint) {
    return picture.at(light.centre + v_p, level_of(picture, light.variance + footprint * footprint / 3.0)) *
           light.irradiance;
}

std::vector<LightPicture> key_light_pictures(const Grating& grating, const colour::LightSpectra& spectra,
                                             std::span<const lighting::KeyLight> lights, const glm::dmat3& space) {
    const double half_width = picture_half_width(grating, spectra);
    const int size = picture_size(half_width, lights);
    const DiffractionPattern pattern = in_space(shaded_pattern(grating, spectra, 2.0 * half_width / size), space);
    std::vector<LightPicture> pictures(lights.size());
    parallel_for(lights.size(), [&](std::size_t i) {
        const double variance = lighting::lobe_moments(lights[i].concentration).variance_across;
        pictures[i] = light_picture(pattern, half_width, glm::vec3(lights[i].flux), kPictureVariance * variance, size);
    });
    return pictures;
}

glm::dvec3 pattern_radiance(const LightPicture& picture, const lighting::KeyLight& light,
                            const std::optional<Cover>& cover, const glm::dmat3& world_to_tangent,
                            const glm::dvec2& v_p, double footprint) {
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    const glm::dvec3 axis = world_to_tangent * light.direction;
    const glm::dvec2 toward(axis);
    // In the plane the lobe is narrower toward the light than across.
    const double steepness = glm::dot(toward, toward);
    const double pixel = footprint * footprint / 3.0;
    const double across = moments.variance_across + pixel;
    const double shown =
        std::max(across + (moments.variance_along - moments.variance_across) * steepness, picture.variance);
    // Gauss–Hermite's three nodes.
    const double apart = std::sqrt(3.0 * std::max(across - shown, 0.0) / std::max(steepness, 1e-12));
    const glm::dvec2 tap = apart * glm::dvec2(-toward.y, toward.x);
    const glm::dvec2 u = moments.mean * toward + v_p;
    if (std::max(std::abs(u.x), std::abs(u.y)) > picture.half_width) return glm::dvec3(0.0);
    const double level = level_of(picture, shown);
    return lobe_height(light.concentration, axis.z) * transmittance(cover, light_spot(light, world_to_tangent)) *
           (2.0 / 3.0 * picture.at(u, level) + 1.0 / 6.0 * (picture.at(u + tap, level) + picture.at(u - tap, level)));
}

glm::dvec3 pattern_radiance(std::span<const LightPicture> pictures, const std::optional<Cover>& cover,
                            std::span<const lighting::KeyLight> lights, const ShadingPoint& frame) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    glm::dvec3 sum(0.0);
    if (v.z <= 0.0) return sum;
    for (std::size_t i = 0; i < lights.size(); ++i)
        sum += pattern_radiance(pictures[i], lights[i], cover, to_tangent, glm::dvec2(v));
    return sum;
}

}  // namespace rowland::diffraction

#include "modules/diffraction/representations/direct/direct.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "engine/core/parallel.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/direct/lobe_table.h"

namespace rowland::diffraction {

namespace {

/// Least half-width of u, so that differences of 𝒦 do not cancel.
constexpr double kNarrowest = 1e-4;

/// A distribution of directions in the tangent frame as its normal approximation, not yet clamped at the horizon.
struct Spread {
    glm::dvec3 mean{0.0};
    double along = 0.0;   ///< variance along the direction
    double across = 0.0;  ///< variance across it
    glm::dvec3 axis{0.0};

    double covariance(int i, int j) const { return (along - across) * axis[i] * axis[j] + (i == j ? across : 0.0); }
};

/// The part of a spread above the horizon, each direction weighted by its cosine. s_g and s_h follow s_n by linear
/// regression.
LightSpot clamp_at_horizon(const Spread& spread) {
    LightSpot spot;
    const double variance_n = std::max(0.0, spread.covariance(2, 2));
    const lighting::ClampedNormal clamped = lighting::clamp_normal(spread.mean.z, std::sqrt(variance_n));
    spot.cosine = clamped.mean;
    spot.centre_n = clamped.mean > 0.0 ? clamped.weighted_mean : 0.0;
    spot.deviation_n = clamped.mean > 0.0 ? std::sqrt(std::max(0.0, clamped.weighted_variance)) : 0.0;
    const double shift = clamped.mean > 0.0 ? clamped.weighted_mean - spread.mean.z : 0.0;
    const auto regress = [&](int axis, double& centre, double& variance) {
        const double slope = variance_n > 0.0 ? spread.covariance(axis, 2) / variance_n : 0.0;
        centre = spread.mean[axis] + slope * shift;
        variance = std::max(0.0, spread.covariance(axis, axis) - slope * slope * variance_n) +
                   slope * slope * clamped.weighted_variance;
    };
    double variance_g = 0.0;
    double variance_h = 0.0;
    regress(0, spot.centre_g, variance_g);
    regress(1, spot.centre_h, variance_h);
    spot.deviation_g = std::sqrt(variance_g);
    spot.deviation_h = std::sqrt(variance_h);
    return spot;
}

/// Least number of slices in which a lobe is summed.
constexpr int kFewestSlices = 54;
/// Width of the slices in x where a lobe has more of them: less than that of the kernel's features.
constexpr double kSlice_nm = 12.0;

/// D_h convolved with a light's normal distribution along the grooves.
double widened_density(const GrooveLobe& lobe, double sum_h, double deviation_h, double wavelength_nm) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) {
        const double wide = std::hypot(gaussian->sigma, deviation_h);
        const double peak = LobeDensity(lobe, wavelength_nm)(0.0) * gaussian->sigma / wide;
        const double z = sum_h / wide;
        return peak * std::exp(-0.5 * z * z);
    }
    if (const auto* sequence = std::get_if<PitSequenceLobe>(&lobe)) {
        PitSequenceLobe wide = *sequence;
        wide.sigma = std::hypot(sequence->sigma, deviation_h);
        // Each order keeps its power over all real numbers.
        const auto inside = [](double sigma) { return std::erf(1.0 / (sigma * std::numbers::sqrt2)); };
        return inside(wide.sigma) / inside(sequence->sigma) * LobeDensity(wide, wavelength_nm)(sum_h);
    }
    // Pits: three-node Gauss–Hermite over the light's extent.
    const LobeDensity density(lobe, wavelength_nm);
    const double step = std::sqrt(3.0) * deviation_h;
    return 2.0 / 3.0 * density(sum_h) + 1.0 / 6.0 * (density(sum_h - step) + density(sum_h + step));
}

glm::dmat3 average(const KernelTable& kernel, double begin_nm, double end_nm, double v_g) {
    return kernel.average(begin_nm, end_nm, v_g);
}

/// The exact kernel is that of one view.
glm::dmat3 average(const ColourKernel& kernel, double begin_nm, double end_nm, double) {
    return kernel.average(begin_nm, end_nm);
}

/// Mean of d k(d u) over u ± half, with order 0.
template <typename Kernel>
glm::dmat3 mean_over(const Kernel& kernel, const DirectMaterial& material, double u, double half, double v_g) {
    const double d = material.pitch_nm;
    glm::dmat3 mean = d * average(kernel, d * (u - half), d * (u + half), v_g);
    if (std::abs(u) < half) mean += material.zero_order_xyz / (2.0 * half);
    return mean;
}

/// Mean of d k(d u), with order 0, for light within centre_g ± half_g and over the pixel.
template <typename Kernel>
glm::dmat3 seen_over(const Kernel& kernel, const DirectMaterial& material, const DirectView& view, double centre_g,
                     double half_g) {
    const double half = std::hypot(half_g, view.footprint);
    return mean_over(kernel, material, centre_g + view.v_g, std::max(half, kNarrowest), view.v_g);
}

/// The same from a smoothed kernel, which holds the mean, but without order 0.
glm::dmat3 seen_over(const BlurredKernel& kernel, const DirectMaterial& material, const DirectView& view,
                     double centre_g, double half_g) {
    const double d = material.pitch_nm;
    return d * kernel.at(d * (centre_g + view.v_g), d * std::hypot(half_g, view.footprint) / std::sqrt(3.0), view.v_g);
}

/// s_n⁺ d k̄: what direct_radiance() needs of a kernel.
template <typename Kernel>
glm::dmat3 sum_over(const Kernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                    const DirectView& view) {
    // A box's variance is a third of its half-width's square.
    if (spot.concentration <= 0.0)
        return spot.cosine * seen_over(kernel, material, view, spot.centre_g, std::sqrt(3.0) * spot.deviation_g);
    const LobeCosine lobe(spot.axis, spot.concentration);
    const double extent_nm = (lobe.end() - lobe.begin()) * material.pitch_nm;
    glm::dmat3 sum(0.0);
    for (const LobeSlice& slice : lobe_slices(lobe, std::max(kFewestSlices, static_cast<int>(extent_nm / kSlice_nm))))
        sum += slice.cosine * seen_over(kernel, material, view, 0.5 * (slice.begin_g + slice.end_g),
                                        0.5 * (slice.end_g - slice.begin_g));
    return sum;
}

template <typename Kernel>
glm::dvec3 seen_through(const Kernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                        const DirectView& view) {
    return transmittance(material.cover, spot) * groove_factor(material.lobe, spot, view.v_h) *
           (0.5 * (sum_over(kernel, material, spot, view) * spot.flux));
}

template <typename Light>
glm::dvec3 sum_of_lights(const KernelTable& kernel, const DirectMaterial& material, std::span<const Light> lights,
                         const ShadingPoint& frame, double footprint) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    glm::dvec3 sum(0.0);
    if (v.z <= 0.0) return sum;
    for (const Light& light : lights)
        sum += direct_radiance(kernel, material, light_spot(light, to_tangent), {v.x, v.y, footprint});
    return sum;
}

}  // namespace

LightSpot light_spot(const DirectLight& light, const glm::dmat3& world_to_tangent) {
    const double half = std::sin(0.5 * light.angular_radius);
    const double mean = 1.0 - half * half;  // (1 + cos α)/2
    // Over a cap of height h = 1 − cos α the cosine to its axis is uniform: variance h²/12. The rest of |s|² = 1 is
    // divided between the two directions across.
    const double height = 2.0 * half * half;
    const double along = height * height / 12.0;
    const double across = 0.5 * (1.0 - mean * mean - along);
    const glm::dvec3 axis = world_to_tangent * light.direction;
    LightSpot spot = clamp_at_horizon({mean * axis, along, across, axis});
    spot.flux = light.flux;
    return spot;
}

LightSpot light_spot(const lighting::KeyLight& light, const glm::dmat3& world_to_tangent) {
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    const glm::dvec3 axis = world_to_tangent * light.direction;
    LightSpot spot = clamp_at_horizon({moments.mean * axis, moments.variance_along, moments.variance_across, axis});
    spot.flux = light.flux;
    spot.axis = axis;
    spot.concentration = light.concentration;
    return spot;
}

glm::dvec3 groove_factor(const GrooveLobe& lobe, const LightSpot& spot, double v_h) {
    if (is_flat(lobe)) return glm::dvec3(1.0);
    glm::dvec3 factor;
    for (int o = 0; o < 3; ++o)
        factor[o] = 2.0 * widened_density(lobe, spot.centre_h + v_h, spot.deviation_h, kPitsWavelengths_nm[o]);
    return factor;
}

double transmittance(const std::optional<Cover>& cover, const LightSpot& spot) {
    if (!cover) return 1.0;
    return 0.5 * (transmittance(cover->ior, spot.centre_n - spot.deviation_n) +
                  transmittance(cover->ior, std::min(1.0, spot.centre_n + spot.deviation_n)));
}

glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view) {
    return seen_through(kernel, material, spot, view);
}

glm::dvec3 direct_radiance(const ColourKernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view) {
    return seen_through(kernel, material, spot, view);
}

glm::dvec3 direct_radiance(const BlurredKernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view) {
    return seen_through(kernel, material, spot, view);
}

glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material,
                           std::span<const DirectLight> lights, const ShadingPoint& frame, double footprint) {
    return sum_of_lights(kernel, material, lights, frame, footprint);
}

glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material,
                           std::span<const lighting::KeyLight> lights, const ShadingPoint& frame, double footprint) {
    return sum_of_lights(kernel, material, lights, frame, footprint);
}

namespace {

constexpr int kSmallestPicture = 128;
/// Limit of the texels of all lights' finest levels together.
constexpr std::size_t kMostTexels = std::size_t{1} << 22;
/// Texels per standard deviation of the finest level's blur. More do not reduce the error against the reference.
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
    // Three Gauss–Hermite nodes across the direction toward the light.
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

const RepresentationInfo& DirectSettings::info() {
    static const RepresentationInfo info{
        .name = "direct",
        .file_number = 3,
        .summary = "key lights and analytic lights alone",
        .lattices = true,
        .key_lights = KeyLightUse::Always,
        .budget = [](const Grating&, SurfaceShape) { return std::vector<std::string>{""}; }};
    return info;
}

DirectSettings DirectSettings::from(const SettingValues&, const Grating&) {
    return {};
}

DirectTables bake(const Grating&, const DirectSettings&) {
    return {};
}

void write(const DirectTables&, ByteWriter&) {}

DirectTables read(ByteReader&, const DirectSettings&) {
    return {};
}

ShadingCost cost(const DirectTables&) {
    return {};
}

Facts facts(const DirectTables&) {
    return {};
}

PointShader point_shader(const DirectTables&, const MaterialKernel&, const EvaluationLight&) {
    return [](const ShadingPoint&) { return glm::dvec3(0.0); };
}

}  // namespace rowland::diffraction

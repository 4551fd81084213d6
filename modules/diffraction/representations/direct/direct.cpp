#include "modules/diffraction/representations/direct/direct.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/representations/direct/lobe_cosine.h"

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
    LightSpot::Part& part = spot.parts[0];
    const double variance_n = std::max(0.0, spread.covariance(2, 2));
    const lighting::ClampedNormal clamped = lighting::clamp_normal(spread.mean.z, std::sqrt(variance_n));
    part.cosine = clamped.mean;
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
    regress(0, part.centre_g, variance_g);
    regress(1, spot.centre_h, variance_h);
    part.deviation_g = std::sqrt(variance_g);
    spot.deviation_h = std::sqrt(variance_h);
    return spot;
}

/// A lobe is summed in slices: at least so many, and none wider than this in x, so that the kernel's width hides the
/// steps.
constexpr int kFewestSlices = 54;
constexpr double kSlice_nm = 12.0;

/// D_h convolved with a light's normal distribution along the grooves.
double widened_density(const GrooveLobe& lobe, double sum_h, double deviation_h, double wavelength_nm) {
    if (const auto* gaussian = std::get_if<GaussianLobe>(&lobe)) {
        const double wide = std::hypot(gaussian->sigma, deviation_h);
        const double peak = LobeDensity(lobe, wavelength_nm)(0.0) * gaussian->sigma / wide;
        const double z = sum_h / wide;
        return peak * std::exp(-0.5 * z * z);
    }
    // Pits: three-node Gauss–Hermite over the light's extent.
    const LobeDensity density(lobe, wavelength_nm);
    const double step = std::sqrt(3.0) * deviation_h;
    return 2.0 / 3.0 * density(sum_h) + 1.0 / 6.0 * (density(sum_h - step) + density(sum_h + step));
}

/// Mean of d k(d u) over u ± half, with order 0.
template <typename Kernel>
glm::dmat3 mean_over(const Kernel& kernel, const DirectMaterial& material, double u, double half) {
    const double d = material.pitch_nm;
    glm::dmat3 mean = d * kernel.average(d * (u - half), d * (u + half));
    if (std::abs(u) < half) mean += material.zero_order_xyz / (2.0 * half);
    return mean;
}

/// Σ_parts s_n⁺ d k̄: what direct_radiance() needs of a kernel.
template <typename Kernel>
glm::dmat3 sum_over_parts(const Kernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                          const DirectView& view) {
    glm::dmat3 sum(0.0);
    for (const LightSpot::Part& part : spot.parts) {
        if (part.cosine <= 0.0) continue;
        // A box's variance is a third of its half-width's square.
        const double half = std::hypot(std::sqrt(3.0) * part.deviation_g, view.footprint);
        sum += part.cosine * mean_over(kernel, material, part.centre_g + view.v_g, std::max(half, kNarrowest));
    }
    return sum;
}

template <typename Kernel>
glm::dmat3 sum_over_slices(const Kernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view) {
    const LobeCosine lobe(spot.axis, spot.concentration);
    const double extent_nm = (lobe.end() - lobe.begin()) * material.pitch_nm;
    glm::dmat3 sum(0.0);
    for (const LobeSlice& slice : lobe_slices(lobe, std::max(kFewestSlices, static_cast<int>(extent_nm / kSlice_nm)))) {
        const double half = std::hypot(0.5 * (slice.end_g - slice.begin_g), view.footprint);
        sum += slice.cosine *
               mean_over(kernel, material, 0.5 * (slice.begin_g + slice.end_g) + view.v_g, std::max(half, kNarrowest));
    }
    return sum;
}

template <typename Kernel>
glm::dmat3 sum_over(const Kernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                    const DirectView& view) {
    return spot.concentration > 0.0 ? sum_over_slices(kernel, material, spot, view)
                                    : sum_over_parts(kernel, material, spot, view);
}

/// The smoothed kernel holds the mean over a part.
glm::dmat3 sum_over(const BlurredKernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                    const DirectView& view) {
    const double d = material.pitch_nm;
    glm::dmat3 sum(0.0);
    for (const LightSpot::Part& part : spot.parts) {
        if (part.cosine <= 0.0) continue;
        const double deviation = std::hypot(part.deviation_g, view.footprint / std::sqrt(3.0));
        sum += part.cosine * d * kernel.at(d * (part.centre_g + view.v_g), d * deviation);
    }
    return sum;
}

template <typename Kernel>
glm::dvec3 seen_through(const Kernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                        const DirectView& view) {
    return transmittance(material.cover, spot) * groove_factor(material.lobe, spot, view.v_h) *
           (0.5 * (sum_over(kernel, material, spot, view) * spot.flux));
}

/// mean_above_wide() for z ≥ kFewTurns, exact in the tails also.
double mean_above_narrow(double sine, double cosine, double z) {
    const double whole = std::sqrt(2.0 * std::numbers::pi / z) * (1.0 + 1.0 / (8.0 * z) + 9.0 / (128.0 * z * z));
    return light_above_narrow(sine, cosine, z) / whole;
}

constexpr double kFewTurns = 3.0;

double mean_above(double sine, double cosine, double concentration) {
    // sin t = sin(π − t), so t₀ can be taken in (−π/2, π/2).
    return concentration < kFewTurns ? mean_above_wide(sine, concentration)
                                     : mean_above_narrow(sine, std::abs(cosine), concentration);
}

/// A lobe along `axis` (tangent frame) in parts. With s_g = sin ψ its density is √cos ψ exp(κ cos(ψ − ψ₀)) in ψ, times
/// a von Mises distribution of concentration κ cos ψ cos ψ₀ around g (both by I₀(z) ≈ e^z/√(2πz)). The normal
/// distribution of ψ is split into three, whose nodes hold `kBetween` of its variance (Gauss–Hermite). The factor √cos
/// ψ · s_n ~ cos^1.5 ψ weights the nodes and shifts the distribution around each.
std::array<LightSpot::Part, 3> lobe_parts(const glm::dvec3& axis, double concentration) {
    constexpr double kBetween = 0.3;
    constexpr double kWithin = 1.0 - kBetween;
    constexpr std::array<double, 3> kWeights{2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0};
    // The parts are normal and have no skewness. Their widths change faster with ψ than cos ψ, so that together they
    // have the lobe's skewness, −3 tan ψ σ⁴.
    constexpr double kSkew = 1.0 + kWithin / (2.0 * kBetween);
    const double step = std::sqrt(3.0 * kBetween / concentration);
    const double variance = kWithin / concentration;
    const double psi0 = std::asin(std::clamp(axis.x, -1.0, 1.0));
    const double across = std::max(std::hypot(axis.y, axis.z), 1e-9);
    const auto above = [&](double cosine) {
        return mean_above(axis.z / across, axis.y / across, concentration * std::max(0.0, cosine) * across);
    };
    std::array<LightSpot::Part, 3> parts{};
    double total = 0.0;
    // Logarithmic derivative over ψ of the part above the horizon: it also shifts the parts.
    const double plus = above(std::cos(psi0 + step));
    const double minus = above(std::cos(psi0 - step));
    const double growth = plus > 0.0 && minus > 0.0 ? std::log(plus / minus) / (2.0 * step) : 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double psi = psi0 + (i == 0 ? 0.0 : i == 1 ? step : -step);
        const double cosine = std::cos(psi);
        if (cosine <= 0.0) continue;
        const double weight = kWeights[i] * std::sqrt(cosine);
        total += weight;
        // ψ is singular at the poles: the shift is clamped to the lobe's width.
        const double shift =
            std::clamp(variance * (growth - 1.5 * std::tan(psi)), -std::sqrt(variance), std::sqrt(variance));
        parts[i] = {weight * cosine * above(cosine), std::sin(psi + shift) * std::exp(-0.5 * variance),
                    std::sqrt(variance) * across * std::min(std::pow(cosine / across, kSkew), 2.0)};
    }
    for (LightSpot::Part& part : parts) part.cosine /= total;
    return parts;
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

double mean_above_wide(double sine, double concentration) {
    const double bound = 0.5 + std::sqrt(concentration * concentration + 2.25);
    const double mean = concentration / bound * sine;
    const double second = 1.0 - 2.0 / bound;  // I₂/I₀
    const double square = 0.5 * (1.0 - second * (1.0 - 2.0 * sine * sine));
    return lighting::clamp_normal(mean, std::sqrt(std::max(0.0, square - mean * mean))).mean;
}

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
    spot.parts = lobe_parts(axis, light.concentration);
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

}  // namespace rowland::diffraction

#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"

namespace rowland::lighting {

/// A bright part of a probe as a von Mises–Fisher lobe: radiance(s) = flux · lobe_density(key, s).
struct KeyLight {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, world axes, toward the light
    glm::dvec3 flux{0.0};                 ///< linear Rec.709 RGB radiance × sr: irradiance on a surface that faces it
    double concentration = 100.0;         ///< κ > 0; about 1/κ is the variance of the angle along each axis
};

/// Most key lights that shaders take.
inline constexpr int kMaximumKeyLights = 64;

/// κ/(4π sinh κ) exp(κ s·direction), 1/sr; it integrates to 1. Stable for κ in [1e-3, 1e5] and beyond.
double lobe_density(const KeyLight& key, const glm::dvec3& s);

/// Factor by which a lobe of concentration κ > 0 multiplies bands 0 … bands−1 of a point light's SH:
/// I_{l+½}(κ)/I_½(κ), to 1e-10.
std::vector<double> lobe_band_factors(double concentration, int bands);

/// Objective of the fit of key lights: the squared error of the lobes plus the residual() in exact_bands as SH,
/// smoothed and weighted by direction (DirectionWeight). Band l has weight ≈ 1/l, as in the mean over all circles of
/// the light's line integral.
struct KeyLightFit {
    /// Concentration of the smoothing lobe: detail finer than 1/√smoothing rad, .02 by default, is ignored. An order's
    /// colours on a compact disc are .026 rad wide.
    double smoothing = 2500.0;
    /// residual() is exact in these bands. 1 to 32.
    int exact_bands = 5;
};

/// Up to `count` (0 to 64) lobes for the bright parts of a probe; fewer where more do not reduce the error. Greedy
/// selection of 3/2 · count lobes, removal of the least important ones, and refinement of each lobe against the
/// residual of the others. Sorted by importance: repeatedly remove the least important lobe; the one removed last comes
/// first. Fluxes solve least squares under flux ≥ 0, so the residual is small on either side of 0. No lobe is narrower
/// than a texel or kNarrowestConcentration, or wider than kWidestConcentration. Does not depend on the number of
/// threads.
std::vector<KeyLight> fit_key_lights(const ProbeImage& probe, int count, const KeyLightFit& settings = {});

/// The widest and the narrowest lobe that fit_key_lights() gives.
inline constexpr double kWidestConcentration = 40.0;
inline constexpr double kNarrowestConcentration = 1e6;

/// Raw radiance SH of the lobes, in closed form; 1 ≤ bands ≤ 32.
ShLight project(std::span<const KeyLight> keys, int bands);

/// SH(probe) − SH(lobes) in exactly `bands` bands. In these its sum with the lobes equals the probe.
ShLight residual(const ShLight& probe, std::span<const KeyLight> keys, int bands);

/// Means over a lobe: A₁(κ) = mean of s·direction, and the variances of s along the direction and across it.
struct LobeMoments {
    double mean = 0.0;
    double variance_along = 0.0;
    double variance_across = 0.0;
};
LobeMoments lobe_moments(double concentration);

/// Moments of x⁺ = max(0, x) for a normally distributed x of given mean and deviation σ ≥ 0; all are 0 where E[x⁺] is
/// below 1e-12 σ.
struct ClampedNormal {
    double mean = 0.0;               ///< E[x⁺]
    double weighted_mean = 0.0;      ///< E[x x⁺] / E[x⁺]
    double weighted_variance = 0.0;  ///< E[x² x⁺] / E[x⁺] − weighted_mean²
};
ClampedNormal clamp_normal(double mean, double deviation);

/// Irradiance from lobes on a surface of a unit normal: the sum of flux times the mean of the clamped cosine
/// max(0, s·normal) over the lobe. Takes the cosine as normally distributed, with its exact mean and variance: error
/// .001 of the flux at κ = 25 and .0001 at 100 (.004 at 10, .023 at worst, κ = 1), against quadrature.
class LobeIrradiance {
 public:
    /// `keys` must outlive it.
    explicit LobeIrradiance(std::span<const KeyLight> keys);
    glm::dvec3 operator()(const glm::dvec3& normal) const;

 private:
    std::span<const KeyLight> keys_;
    std::vector<LobeMoments> moments_;
};

}  // namespace rowland::lighting

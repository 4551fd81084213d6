#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "engine/lighting/key_lights.h"
#include "modules/diffraction/bake/blurred_kernel.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/cover.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::diffraction {

/// A lamp of uniform radiance: a disc, or punctual with angular_radius 0.
struct DirectLight {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, world axes, toward the light
    glm::dvec3 flux{0.0};                 ///< linear RGB radiance × sr: irradiance on a surface that faces it
    double angular_radius = 0.0;          ///< radians
};

/// A light in a surface's tangent frame: what a grating sees of it.
struct LightSpot {
    glm::dvec3 flux{0.0};
    double cosine = 0.0;         ///< mean of s_n⁺ over the light
    double centre_g = 0.0;       ///< mean s_g, directions weighted by s_n⁺
    double deviation_g = 0.0;    ///< standard deviation of s_g, likewise
    double centre_h = 0.0;       ///< mean s_h, likewise
    double deviation_h = 0.0;    ///< standard deviation of s_h, likewise
    double centre_n = 0.0;       ///< mean s_n⁺, likewise
    double deviation_n = 0.0;    ///< standard deviation of s_n⁺, likewise
    glm::dvec3 axis{0.0};        ///< of a lobe
    double concentration = 0.0;  ///< of a lobe; 0: a disc
};

/// A disc, as one box of its variance in s_g.
LightSpot light_spot(const DirectLight& light, const glm::dmat3& world_to_tangent);

/// A von Mises–Fisher lobe.
LightSpot light_spot(const lighting::KeyLight& light, const glm::dmat3& world_to_tangent);

/// The view of a point and the pixel's extent.
struct DirectView {
    double v_g = 0.0;
    double v_h = 0.0;
    double footprint = 0.0;  ///< half the extent of the pixel in u = s_g + v_g
};

/// The material's data beside the kernel.
struct DirectMaterial {
    double pitch_nm = 0.0;
    glm::dmat3 zero_order_xyz{0.0};  ///< ColourKernel::zero_order_xyz(): at u ≈ 0, if order 0 is listed
    GrooveLobe lobe = FlatLobe{};
    std::optional<Cover> cover = std::nullopt;
};

/// Wavelengths at which the pits' lobe is evaluated for X, Y and Z. 𝒦 sums over all orders and wavelengths, so the
/// wavelength of a look-up is not known.
inline constexpr glm::dvec3 kPitsWavelengths_nm{591.0, 557.0, 449.0};

/// 2 D_h(s_h + v_h) for X, Y and Z, the lobe widened by the light's own extent along the grooves.
glm::dvec3 groove_factor(const GrooveLobe& lobe, const LightSpot& spot, double v_h);

/// Mean of T over a light, to second order in its extent; 1 without a cover.
double transmittance(const std::optional<Cover>& cover, const LightSpot& spot);

/// XYZ = ½ s_n⁺ d k̄(d u) F · 2 D_h T(s_n) with u = s_g + v_g, PHYSICS §4 and §10, without T(v_n). k̄ is the mean
/// of k over the light and the pixel, from differences of 𝒦. A box is one difference: the squares of its half-width and
/// of the footprint add. A lobe is a sum of slices narrower than the kernel's features (LobeCosine).
glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view);
glm::dvec3 direct_radiance(const ColourKernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view);

/// The same from a smoothed kernel: one look-up for a box or a slice, which counts as a normal distribution of its
/// variance, but as no narrower than a column. Without order 0.
glm::dvec3 direct_radiance(const BlurredKernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view);

/// The sum over lights at a point; black for a view below the horizon.
glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material,
                           std::span<const DirectLight> lights, const ShadingPoint& frame, double footprint = 0.0);
glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material,
                           std::span<const lighting::KeyLight> lights, const ShadingPoint& frame,
                           double footprint = 0.0);

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/model/colour_kernel.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/representations/descriptor.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// A lamp of uniform radiance: a disc, or punctual with angular_radius 0.
struct DirectLight {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit, world axes, toward the light
    glm::dvec3 flux{0.0};                 ///< linear RGB radiance × sr: irradiance on a surface that faces it
    double angular_radius = 0.0;          ///< radians
};

/// A light in a surface's tangent frame: its moments in s_g, s_h and s_n.
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

/// The moments of a disc. direct_radiance() replaces it by a box of the same variance in s_g.
LightSpot light_spot(const DirectLight& light, const glm::dmat3& world_to_tangent);

/// The moments of a von Mises–Fisher lobe.
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

/// Wavelengths at which a lobe that depends on them, of pits or a pit sequence, is evaluated for X, Y and Z. 𝒦 sums
/// over all orders and wavelengths, so the wavelength of a look-up is not known.
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

/// The same from a smoothed kernel, without order 0: one look-up for a box or a slice, which counts as a normal
/// distribution of its variance, but no narrower than a column of the kernel.
glm::dvec3 direct_radiance(const BlurredKernel& kernel, const DirectMaterial& material, const LightSpot& spot,
                           const DirectView& view);

/// The sum over lights at a point; black for a view below the horizon.
glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material,
                           std::span<const DirectLight> lights, const ShadingPoint& frame, double footprint = 0.0);
glm::dvec3 direct_radiance(const KernelTable& kernel, const DirectMaterial& material,
                           std::span<const lighting::KeyLight> lights, const ShadingPoint& frame,
                           double footprint = 0.0);

/// A light on a lattice: its flux on the surface, and its mean and variance in the plane of the surface.
struct PatternLight {
    glm::dvec3 irradiance{0.0};  ///< flux times the mean of s_n⁺, and a cover's T(s_n)
    glm::dvec2 centre{0.0};      ///< mean of (s_g, s_h)
    double variance = 0.0;       ///< mean of the variances of s_g and s_h
};
PatternLight pattern_light(const DirectLight& light, const std::optional<Cover>& cover,
                           const glm::dmat3& world_to_tangent);

/// XYZ = P̄(u) · irradiance, PHYSICS (13.5), without T(v_n): one look-up for all orders. `v_p`: (v_g, v_h); `footprint`:
/// half the extent of the pixel in u.
glm::dvec3 pattern_radiance(const PatternPicture& picture, const PatternLight& light, const glm::dvec2& v_p,
                            double footprint = 0.0);

/// Variance of the blur of a key light's finest level, as a fraction of the light's variance: the least variance in the
/// plane of a light up to 45° from the normal. The next level has the light's whole variance.
inline constexpr double kPictureVariance = 0.5;

/// A picture for each key light, all of one size: as a texture of half floats, 45 MB or less. `space`: the matrix from
/// XYZ to the colour space of the values.
std::vector<LightPicture> key_light_pictures(const Grating& grating, const colour::LightSpectra& spectra,
                                             std::span<const lighting::KeyLight> lights,
                                             const glm::dmat3& space = glm::dmat3(1.0));

/// XYZ of a key light from its picture, PHYSICS (13.6), without T(v_n): three look-ups, since the light is an ellipse
/// in the plane of the surface.
glm::dvec3 pattern_radiance(const LightPicture& picture, const lighting::KeyLight& light,
                            const std::optional<Cover>& cover, const glm::dmat3& world_to_tangent,
                            const glm::dvec2& v_p, double footprint = 0.0);

/// The sum over a probe's key lights at a point; black for a view below the horizon.
glm::dvec3 pattern_radiance(std::span<const LightPicture> pictures, const std::optional<Cover>& cover,
                            std::span<const lighting::KeyLight> lights, const ShadingPoint& frame);

/// Shades the probe's key lights and the scene's analytic lights alone.
struct DirectSettings {
    static const RepresentationInfo& info();
    static DirectSettings from(const SettingValues& values, const Grating& grating);
};

/// Empty: the kernel is part of every material.
struct DirectTables {};

DirectTables bake(const Grating& grating, const DirectSettings& settings);
void write(const DirectTables& tables, ByteWriter& writer);
DirectTables read(ByteReader& reader, const DirectSettings& settings);
ShadingCost cost(const DirectTables& tables);
Facts facts(const DirectTables& tables);
PointShader point_shader(const DirectTables& tables, const MaterialKernel& material, const EvaluationLight& light);

}  // namespace rowland::diffraction

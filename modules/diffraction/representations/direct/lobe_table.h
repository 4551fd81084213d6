#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/direct/direct.h"

namespace rowland::diffraction {

/// The light of a von Mises–Fisher lobe as a density over ψ, with s_g = sin ψ: its integral is the mean of s_n⁺ over
/// the lobe. Also exact where the horizon cuts the lobe and where the lobe surrounds g.
class LobeCosine {
 public:
    /// `axis`: the lobe's direction in the tangent frame, unit.
    LobeCosine(const glm::dvec3& axis, double concentration);

    /// κ cos²ψ / (2π (1 − e^−2κ)) · e^(κ (cos(ψ − ψ₀) − 1)) · ∫₀^π sin t e^(z (cos(t − t₀) − 1)) dt,
    /// z = κ cos ψ cos ψ₀, t being the angle around g from the horizon.
    double operator()(double psi) const;

    double middle() const { return middle_; }  ///< ψ₀
    double deviation() const;                  ///< 1/√κ
    /// The interval of ψ that holds all but 7e-6 of the light.
    double begin() const;
    double end() const;

 private:
    double concentration_;
    double across_;  ///< cos ψ₀
    double sine_;    ///< of t₀
    double cosine_;
    double middle_;
    double scale_;
};

/// Light between two values of s_g.
struct LobeSlice {
    double cosine = 0.0;  ///< its part of the mean of s_n⁺
    double begin_g = 0.0;
    double end_g = 0.0;
};

/// A lobe in equal slices of ψ.
std::vector<LobeSlice> lobe_slices(const LobeCosine& lobe, int count);

/// A normal distribution of light in s_g.
struct LobeWindow {
    double cosine = 0.0;  ///< its part of the mean of s_n⁺
    double centre_g = 0.0;
    double deviation_g = 0.0;
};

/// A lobe as seven normal distributions in s_g: it is divided among normal windows in ψ (Gauss–Hermite), and each has
/// its window's light, mean and deviation.
std::vector<LobeWindow> lobe_windows(const LobeCosine& lobe);

/// The radiance of a key light on a grating of the flat lobe in one look-up, PHYSICS §11: over the path difference
/// x = d u, u being the mean of s_g + v_g over the lobe and the pixel, and the variance V of u, which tells the widths
/// of both; the sign of s_g tells to which side the lobe is skewed. XYZ = value · lobe_height(). A 2D texture,
/// GL_LINEAR, GL_CLAMP_TO_EDGE, with nodes at texel centres:
///   s = (x − begin)/(end − begin),  t = ½ + sign(s_g) log₂(1 + V/kLeastLobeVariance) 2/rows
struct LobeTable {
    double begin_nm = 0.0;
    double end_nm = 0.0;
    int columns = 0;
    int rows = 0;
    std::vector<glm::vec3> values;  ///< XYZ, row by row

    /// The value that the texture unit interpolates.
    glm::dvec3 at(double s_g, double variance, double x_nm) const;
};

/// Variances below 2^kLobeTableStart are not resolved.
inline constexpr int kLobeTableStart = -18;
inline constexpr double kLeastLobeVariance = 1.0 / (1 << -kLobeTableStart);
/// Octaves from the least variance to 1/16, on either side of n.
inline constexpr int kLobeTableOctaves = 2 * 14;

/// Mean of s_n⁺ over a lobe of concentration κ, with s_n taken as normally distributed. `s_n`: of the lobe's direction.
double lobe_height(double concentration, double s_n);

/// Coefficients, constant term first, of a cubic in |m| that approximates log₂(lobe_height() − max(0, m)), m being the
/// mean of s_n. The error of the height is at most 3e-4 of the lobe's deviation for κ ≥ 40.
glm::dvec4 lobe_height_fit(double concentration);

/// The table of a key light: the radiance of the lobe rotated around g into the plane of g and n (LobeCosine), divided
/// by lobe_height(). It deviates from direct_radiance() where the horizon cuts the lobe. Values are optimised for
/// linear interpolation over x (kBestLinear).
LobeTable make_lobe_table(const BlurredKernel& kernel, const lighting::KeyLight& light, int columns);

/// CPU reference of key_light_tables.glsl: XYZ of a key light from its table. `world_to_tangent`: rows g, h, n.
glm::dvec3 lobe_radiance(const LobeTable& table, const DirectMaterial& material, const lighting::KeyLight& light,
                         const glm::dmat3& world_to_tangent, const DirectView& view);

}  // namespace rowland::diffraction

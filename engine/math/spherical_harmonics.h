#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

namespace rowland::math {

/// Real, orthonormal spherical harmonics over the sphere, no Condon–Shortley phase, polar axis z
/// [Ramamoorthi & Hanrahan 2001]: Y_0 = 0.282095, Y_1,-1 = 0.488603 y, Y_1,0 = 0.488603 z, Y_1,1 = 0.488603 x, ...
/// "n bands" means l < n.
inline constexpr int kMaximumBands = 32;

/// Number of coefficients of `bands` bands: bands².
constexpr int sh_count(int bands) {
    return bands * bands;
}

/// Index of (l, m): l(l+1)+m.
constexpr int sh_index(int l, int m) {
    return l * (l + 1) + m;
}

/// Evaluates all `bands`² functions at the unit vector `direction` into `values` (size ≥ bands², 1 ≤ bands ≤ 32), by
/// stable recurrences in l and m. Error < 1e-13 at 32 bands.
void evaluate_sh(const glm::dvec3& direction, int bands, std::span<double> values);

/// Windows against ringing, the weakest first. A window multiplies band l of band-limited light by a factor that falls
/// from 1 at l = 0 (None: 1); it lowers peaks and reduces undershoot [Sloan 2008, "Stupid SH tricks", windowing].
enum class SphericalWindow { None, Lanczos, Hann };

/// "none", "lanczos" or "hann".
const char* window_name(SphericalWindow window);
/// Inverse of window_name. The name must be one of the three.
SphericalWindow parse_window(std::string_view name);

/// Factor of band l, 0 ≤ l < bands: 1, sin(πl/n)/(πl/n) or (1 + cos(πl/n))/2 with n = bands. A point light of 5 bands
/// peaks at 1.99, 1.05 and 0.82.
double window_factor(SphericalWindow window, int l, int bands);

/// exp(−damping·l(l+1)), damping ≥ 0: the window of heat diffusion on the sphere.
double exponential_window_factor(double damping, int l);

/// Factor A_l by which convolution with the clamped cosine max(0, cos θ) multiplies band l ≥ 0 of radiance, which gives
/// irradiance: A_0 = π, A_1 = 2π/3, A_2 = π/4, A_3 = 0, A_4 = −π/24, ... and 0 for every odd l > 1
/// [Ramamoorthi & Hanrahan 2001, eq. 8]. Exact closed form for any l, to rounding.
double clamped_cosine_factor(int l);

/// Rotates SH coefficients: for f(s) = Σ c_i Y_i(s) and a rotation matrix M, apply() gives the coefficients of f' with
/// f'(M s) = f(s). With M's *rows* (g, h, n), c' describes the same light in the tangent frame (g, h, n).
/// Built per band by the recurrence of Ivanic & Ruedenberg (1996, with the 1998 corrections); no angles are taken, so
/// identity and 180° rotations need no special case. Orthogonal to 1e-12 for bands ≤ 16.
class ShRotation {
 public:
    /// `rotation` must be a proper rotation (determinant +1). 1 ≤ bands ≤ 32.
    ShRotation(const glm::dmat3& rotation, int bands);

    int bands() const { return bands_; }
    /// Entry M_ij of band l, i, j in [-l, l]: ∫ Y_li(M s) Y_lj(s) ds.
    double entry(int l, int i, int j) const;

    /// out = rotated in; both of size ≥ bands², not overlapping.
    void apply(std::span<const double> in, std::span<double> out) const;
    void apply(std::span<const glm::dvec3> in, std::span<glm::dvec3> out) const;

 private:
    int bands_;
    std::vector<double> blocks_;  ///< band l: (2l+1)² entries, row-major, bands one after another
};

}  // namespace rowland::math

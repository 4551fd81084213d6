#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace rowland::diffraction {

/// The light of a von Mises–Fisher lobe over ψ, s_g = sin ψ: the mean of s_n⁺ over the lobe is its integral. Exact
/// where the horizon cuts the lobe and where the lobe surrounds g.
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
    double cosine = 0.0;
    double centre_g = 0.0;
    double deviation_g = 0.0;
};

/// A lobe as seven normal distributions in s_g: it is divided among normal windows in ψ (Gauss–Hermite), and each has
/// its window's light, mean and deviation.
std::vector<LobeWindow> lobe_windows(const LobeCosine& lobe);

}  // namespace rowland::diffraction

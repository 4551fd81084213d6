#pragma once

#include <glm/vec3.hpp>

#include "engine/colour/illuminant.h"

namespace rowland::colour {

/// B_c(λ): the spectra of linear Rec.709 red, green and blue, which sum to 1 [Mallett & Yuksel 2019]. Clamped
/// to the table's ends (380 and 780 nm).
glm::dvec3 rgb_basis(double wavelength_nm);

/// Turns linear RGB into spectral radiance under an illuminant: L(λ) = Σ_c rgb_c E_c(λ), E_c(λ) = k_S S(λ) B_c(λ),
/// k_S = 1/∫S ȳ dλ. Linear, so it commutes with sums over light. rgb is relative to the illuminant's own white; with
/// D65 rgb (1,1,1) has Y = 1 and D65's white.
class LightSpectra {
 public:
    explicit LightSpectra(Illuminant illuminant = d65());

    /// (E_r, E_g, E_b) at a wavelength, per nm.
    glm::dvec3 operator()(double wavelength_nm) const;

    const Illuminant& illuminant() const { return illuminant_; }

 private:
    Illuminant illuminant_;
    double scale_;
};

/// XYZ of light of colour `rgb`: ∫ L(λ) cmf(λ) dλ, trapezoid at 1 nm over the visible range.
glm::dvec3 rgb_to_xyz(const LightSpectra& spectra, const glm::dvec3& rgb);

}  // namespace rowland::colour

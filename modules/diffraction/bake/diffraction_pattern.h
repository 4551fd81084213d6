#pragma once

#include <glm/mat3x3.hpp>
#include <optional>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Where a grating sends light: its diffraction pattern P over u = (s_g + v_g, s_h + v_h), PHYSICS (31). Along g as
/// wavelengths of all orders, along h as the lobe.
struct DiffractionPattern {
    /// The light of one order and wavelength: P = Σ_nodes weight δ(u_g − node.u) D_h(u_h).
    struct Node {
        float u = 0.0F;
        float wavelength_nm = 0.0F;
        glm::mat3 weight{0.0F};  ///< η cmf Eᵀ dλ: linear RGB in, XYZ or another space out
    };
    std::vector<Node> nodes;
    GrooveLobe lobe;
    bool even = false;           ///< P(−u) = P(u)
    std::optional<Cover> cover;  ///< whose T(s_n) is not in P
};

/// Distance in u between the nodes of an order: at most this, and at most that of 1 nm.
inline constexpr double kPatternStep = 0.004;

/// Orders are sharp, efficiencies those at normal incidence. Only |u| ≤ 2, beyond which no pair of directions lies.
DiffractionPattern diffraction_pattern(const Grating& grating, const colour::LightSpectra& spectra);

/// Whether orders m and −m of a grating are equally bright.
bool is_even(const Grating& grating);

/// The pattern in another colour space than XYZ.
DiffractionPattern in_space(DiffractionPattern pattern, const glm::dmat3& xyz_to_space);

}  // namespace rowland::diffraction

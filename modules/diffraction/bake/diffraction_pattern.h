#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Where a grating sends light: its diffraction pattern P over u = (s_g + v_g, s_h + v_h), PHYSICS (31): points for
/// the wavelengths of all orders, which grooves spread along h by their lobe.
struct DiffractionPattern {
    /// The light of one order and wavelength: P = Σ_nodes weight δ(u_g − node.u_g) D_h(u_h − node.u_h).
    struct Node {
        glm::vec2 u{0.0F};  ///< (u_g, u_h); u_h is 0 for grooves
        float wavelength_nm = 0.0F;
        glm::mat3 weight{0.0F};  ///< η cmf Eᵀ dλ: linear RGB in, XYZ or another space out
    };
    std::vector<Node> nodes;
    std::optional<GrooveLobe> lobe;  ///< D_h; none: δ, as of a lattice
    bool even = false;               ///< P(−u) = P(u)
    std::optional<Cover> cover;      ///< whose T(s_n) is not in P
};

/// Distance in u between the nodes of an order: at most this, and of grooves at most that of 1 nm.
inline constexpr double kPatternStep = 0.004;

/// Orders are sharp, efficiencies those at normal incidence. Only |u| ≤ 2, beyond which no pair of directions lies.
/// `step`: between an order's nodes at most; a lattice's wavelengths are joined where they are closer than that.
DiffractionPattern diffraction_pattern(const Grating& grating, const colour::LightSpectra& spectra,
                                       double step = kPatternStep);

/// The same in the frame that a point is shaded in: of a sheet that transmits, lit_from_behind() reverses h.
DiffractionPattern shaded_pattern(const Grating& grating, const colour::LightSpectra& spectra,
                                  double step = kPatternStep);

/// Whether orders m and −m of a grating, or (m, k) and (−m, −k), are equally bright.
bool is_even(const Grating& grating);

/// The pattern in another colour space than XYZ.
DiffractionPattern in_space(DiffractionPattern pattern, const glm::dmat3& xyz_to_space);

}  // namespace rowland::diffraction

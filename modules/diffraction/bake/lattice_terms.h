#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/bake/diffraction_pattern.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// An order of a lattice: wavelength λ lies at u = λ u_per_nm.
struct LatticeOrder {
    glm::dvec2 u_per_nm{0.0};
    std::vector<double> efficiency;  ///< η_mk, the metal's R included, at every nanometre of the visible range
};

/// A lattice's orders that propagate for some pair of directions, except (0, 0) and those of efficiency below 1e-9.
std::vector<LatticeOrder> lattice_orders(const Grating& grating);

/// The orders in the frame that a point is shaded in: for a sheet that transmits, h is reversed (PHYSICS §13).
std::vector<LatticeOrder> shaded_lattice_orders(const Grating& grating);

/// Σ η T(s_n) Y_i(s) over the orders of one view (v_g, v_h), PHYSICS (13.4): [j·bands² + i], j nanometres above
/// kVisibleMin.
std::vector<double> lattice_spectrum(const std::vector<LatticeOrder>& orders, const std::optional<Cover>& cover,
                                     const glm::dvec2& view, int bands);

/// The diffraction term of a lattice as SH coefficients, integrated over wavelength.
class LatticeTerms {
 public:
    LatticeTerms(const Grating& grating, const colour::LightSpectra& spectra, int bands);

    /// c_i of a view (v_g, v_h), [i] RGB in, XYZ out, in the frame (g, h, n). Accurate to 4e-4 for up to 100 orders;
    /// more may be binned on a grid in u of spacing max(0.03 / bands, 0.004), which is accurate to 3e-3.
    std::vector<glm::dmat3> coefficients(const glm::dvec2& view) const;

 private:
    struct Point {
        glm::dvec2 u{0.0};
        glm::dmat3 weight{0.0};
    };
    std::vector<LatticeOrder> orders_;
    std::vector<glm::dmat3> observed_;  ///< cmf Eᵀ dλ at every nanometre
    std::vector<Point> points_;         ///< empty: the orders are summed one by one
    std::optional<Cover> cover_;
    double grid_step_;  ///< extent of a point in u
    int bands_;
};

/// The diffraction pattern of a grating with a lattice as points, PHYSICS (13.1). An order's points are at most `step`
/// apart in u; each holds all light of the wavelengths around it. Orders as in lattice_orders().
std::vector<DiffractionPattern::Node> lattice_nodes(const Grating& grating, const colour::LightSpectra& spectra,
                                                    double step);

}  // namespace rowland::diffraction

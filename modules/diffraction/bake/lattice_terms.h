#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <vector>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/bake/lattice_orders.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// Σ η T(s_n) Y_i(s) over the orders of one view, PHYSICS (51), for every nanometre: [j·bands² + i].
std::vector<double> lattice_spectrum(const std::vector<LatticeOrder>& orders, const std::optional<Cover>& cover,
                                     const glm::dvec2& view, int bands);

/// The diffraction term of a lattice as SH coefficients with the wavelengths summed.
class LatticeTerms {
 public:
    LatticeTerms(const Grating& grating, const colour::LightSpectra& spectra, int bands);

    /// c_i of a view (v_g, v_h), [i] RGB in, XYZ out, in the frame (g, h, n): 4e-4 exact up to 100 orders. The
    /// points of more are joined where harmonics can hardly tell them apart: 3e-3.
    std::vector<glm::dmat3> coefficients(const glm::dvec2& view) const;

 private:
    struct Point {
        glm::dvec2 u{0.0};
        glm::dmat3 weight{0.0};
    };
    std::vector<LatticeOrder> orders_;
    std::vector<glm::dmat3> observed_;  ///< cmf Eᵀ dλ at every nanometre
    std::vector<Point> points_;         ///< none: the orders one by one
    std::optional<Cover> cover_;
    double cell_;  ///< extent of a point in u
    int bands_;
};

}  // namespace rowland::diffraction

#pragma once

#include <cstdint>
#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>
#include <variant>
#include <vector>

#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

/// Two sets of grooves that add their heights: η = η_m of those along a times η_k of those along b.
struct CrossedProfile {
    Profile along_a;  ///< of the grooves that cross a; no table
    Profile along_b;
};

/// One opening in each cell, with sides along a and b: the lit part of a display's pixel.
struct ApertureProfile {
    double width_nm = 0.0;   ///< along a: 0 < w ≤ |a|
    double height_nm = 0.0;  ///< along b: 0 < l ≤ |b|
};

/// Heights over one cell: columns along a, rows against b, as one sees a picture with b upward.
struct HeightMap {
    int columns = 0;
    int rows = 0;
    std::vector<std::uint8_t> heights;  ///< row by row; 255: raised by the full depth
    double depth_nm = 0.0;
};

using LatticeProfile = std::variant<CrossedProfile, ApertureProfile, HeightMap>;

/// A surface that repeats along two directions. Both are in the surface, as (g, h).
struct Lattice {
    glm::dvec2 a_nm{0.0};
    glm::dvec2 b_nm{0.0};
    LatticeProfile profile = ApertureProfile{};
    int orders = 2;  ///< shaded: every (m, k) with |m|, |k| up to this, but (0, 0)
};

/// The most that a file may list: 10 200 orders.
inline constexpr int kHighestLatticeOrder = 50;

/// Columns a* and b* per nm: a·a* = 1, a·b* = 0. Order (m, k) of wavelength λ lies at u = λ (m a* + k b*), PHYSICS
/// (13.1).
glm::dmat2 reciprocal(const Lattice& lattice);

/// Number of values of m, and of k: 2 orders + 1.
constexpr int order_columns(const Lattice& lattice) {
    return 2 * lattice.orders + 1;
}

/// η_mk of a perfectly reflecting surface (R = 1) for every |m|, |k| up to lattice.orders, (0, 0) included: at
/// [(k + orders) · order_columns + m + orders]. Scalar theory at normal incidence; Goodman, Introduction to Fourier
/// Optics, ch. 4. wavelength_nm > 0, in the medium over the surface.
std::vector<double> lattice_efficiencies(const Lattice& lattice, double wavelength_nm);
/// η_00 alone.
double lattice_zero_order(const Lattice& lattice, double wavelength_nm);

}  // namespace rowland::diffraction

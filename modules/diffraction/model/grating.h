#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "engine/colour/metal.h"
#include "modules/diffraction/model/cover.h"
#include "modules/diffraction/model/lattice.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/model/profile.h"
#include "modules/diffraction/model/transmission.h"

namespace rowland::diffraction {

enum class Normalization {
    Energy,  ///< each order carries its efficiency: reciprocal, conserves energy
    Agu,     ///< the paper's peak form (slit only): each order times λ/550 nm, equal to Energy at 550 nm
};

/// From this many lit grooves on, an order is a delta function (N → ∞, PHYSICS §3).
inline constexpr double kManyGrooves = 50.0;

/// Wavelength at which the two normalisations agree.
inline constexpr double kAguWavelength_nm = 550.0;

/// A grating: everything that the diffraction term depends on.
struct Grating {
    double pitch_nm = 0.0;    ///< groove distance d > 0
    double grooves = 1500.0;  ///< lit grooves N ≥ 1
    Profile profile = SlitProfile{};
    std::vector<int> orders = {-2, -1, 1, 2};  ///< that are shaded: ascending, no duplicates
    Normalization normalization = Normalization::Energy;
    GrooveLobe lobe = FlatLobe{};
    std::optional<colour::Metal> metal = std::nullopt;  ///< none: R = 1. A table includes its metal
    std::optional<Cover> cover = std::nullopt;          ///< none: the grooves lie in air
    /// Instead of grooves: `orders` is then empty, and pitch_nm the shorter side of a cell.
    std::optional<Lattice> lattice = std::nullopt;
    /// None: the orders are reflected. A sheet that transmits them has no metal and no cover.
    std::optional<Transmission> transmission = std::nullopt;
    std::optional<double> side_reflectance = std::nullopt;  ///< of reflected_side(): R at all wavelengths
};

/// What a sheet reflects, by the same orders, as a grating of its own; nullopt for nothing.
inline std::optional<Grating> reflected_side(const Grating& sheet) {
    if (!sheet.transmission || sheet.transmission->reflectance == 0.0) return std::nullopt;
    Grating side = sheet;
    side.transmission.reset();
    side.side_reflectance = sheet.transmission->reflectance;
    return side;
}

/// Whether radiance depends on the view's v_g alone: grooves of the flat lobe.
inline bool sees_v_g_alone(const Grating& grating) {
    return !grating.lattice && is_flat(grating.lobe);
}

/// Whether the grating shades the order.
inline bool lists(const Grating& grating, int order) {
    return std::binary_search(grating.orders.begin(), grating.orders.end(), order);
}

}  // namespace rowland::diffraction

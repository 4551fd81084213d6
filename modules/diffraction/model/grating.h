#pragma once

#include <optional>
#include <vector>

#include "engine/colour/metal.h"
#include "modules/diffraction/model/lobe.h"
#include "modules/diffraction/model/profile.h"

namespace rowland::diffraction {

enum class Normalization {
    Energy,  ///< each order carries its efficiency: reciprocal, never more out than in
    Agu,     ///< the paper's peak form (slit only): each order times λ/550 nm, equal to Energy at 550 nm
};

/// From this many lit grooves on, an order is a delta function: N → ∞ (PHYSICS §3).
inline constexpr double kManyGrooves = 50.0;

/// Wavelength at which the two normalisations agree.
inline constexpr double kAguWavelength_nm = 550.0;

/// A reflection grating: everything the diffraction term depends on. What the material file's "grating" holds.
struct Grating {
    double pitch_nm = 0.0;    ///< groove distance d > 0
    double grooves = 1500.0;  ///< lit grooves N ≥ 1
    Profile profile = SlitProfile{};
    std::vector<int> orders = {-2, -1, 1, 2};  ///< the orders that are shaded, ascending, no duplicates
    Normalization normalization = Normalization::Energy;
    GrooveLobe lobe = FlatLobe{};
    std::optional<colour::Metal> metal = std::nullopt;  ///< none: a perfect mirror, R = 1. None with a table
};

}  // namespace rowland::diffraction

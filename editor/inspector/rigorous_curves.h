#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "engine/colour/spectrum.h"
#include "modules/diffraction/rigorous/relief.h"

namespace rowland::inspector {

/// A relief, the orders to show, and the light.
struct RigorousInputs {
    diffraction::Relief relief;
    diffraction::Substrate substrate = colour::Metal::Al;
    std::vector<int> orders;     ///< ascending
    double wavelength_nm = 550;  ///< of the curves over incidence
    double s_g = 0.0;            ///< of the curves over wavelength, |s_g| < 1

    friend bool operator==(const RigorousInputs&, const RigorousInputs&) = default;
};

/// Efficiencies by Maxwell's equations of light whose electric field lies along (TE) and across (TM) the grooves.
struct PolarisedPoint {
    double at = 0.0;  ///< wavelength in nm, or angle of incidence in degrees
    double te = 0.0;
    double tm = 0.0;

    double mean() const { return (te + tm) / 2.0; }
};

/// Efficiencies of one order where it leaves the surface, sorted by PolarisedPoint::at.
struct RigorousOrder {
    int order = 0;
    std::vector<PolarisedPoint> over_wavelength;  ///< 380 to 780 nm
    std::vector<PolarisedPoint> over_incidence;
};

/// Publishes coarse curves: a point every 50 nm, and every 6° near normal incidence, with the smallest truncation that
/// is worth trying; they are within 0.02 of the final ones. Then returns converged curves: every 10 nm and 1.5°, within
/// 0.002. nullopt if it was stopped. Throws Error (input) if the relief does not converge.
std::optional<std::vector<RigorousOrder>> rigorous_curves(
    const RigorousInputs& inputs, const std::stop_token& stop,
    const std::function<void(std::vector<RigorousOrder>)>& publish);

}  // namespace rowland::inspector

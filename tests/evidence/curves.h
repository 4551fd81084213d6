#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "modules/diffraction/model/grating.h"

namespace rowland::evidence {

/// A point of a manufacturer's curve with the models' values there: the fraction of unpolarised light that the first
/// order takes at Littrow, s_g = v_g = λ/2d.
struct CurvePoint {
    double wavelength_nm = 0.0;
    double measured = 0.0;
    double scalar = 0.0;
    double rigorous = 0.0;
};

/// A curve's rows of 380 to 780 nm, each `stride`-th, and the models of `grating` there: a blazed relief of a metal.
/// Throws Error (input) for a missing or malformed file.
std::vector<CurvePoint> compare_curve(const std::filesystem::path& csv, const diffraction::Grating& grating,
                                      std::size_t stride = 1);

/// RMS difference of a model's efficiencies from the measured ones.
double curve_rms(const std::vector<CurvePoint>& curve, double CurvePoint::*model);

/// A manufacturer's grating and the model for it.
struct RuledGrating {
    std::string name;   ///< "ruled_600"
    std::string curve;  ///< file of the data folder
    diffraction::Grating grating;
    std::string depth_from;  ///< what sets the depth
};

/// The two presets as users have them, and a third grating twice: fitted, and with the depth of its blaze by name.
std::vector<RuledGrating> ruled_gratings();

}  // namespace rowland::evidence

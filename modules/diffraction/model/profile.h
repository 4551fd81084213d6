#pragma once

#include <variant>

#include "modules/diffraction/model/efficiency_table.h"

namespace rowland::diffraction {

/// A slit of width b in every pitch d (Agu's groove): η_m = (b/d)² sinc²(m b/d).
struct SlitProfile {
    double width_nm = 0.0;  ///< 0 < b ≤ pitch
};

/// A rectangular groove: a share `duty` of the pitch is raised by `depth_nm`.
struct LamellarProfile {
    double duty = 0.5;  ///< 0 < w < 1
    double depth_nm = 0.0;
};

/// A sinusoidal groove; the depth is peak to peak.
struct SinusoidalProfile {
    double depth_nm = 0.0;
};

/// A linear ramp whose depth grows toward +g: it favours orders m > 0.
struct BlazedProfile {
    double depth_nm = 0.0;
};

using Profile = std::variant<SlitProfile, LamellarProfile, SinusoidalProfile, BlazedProfile, EfficiencyTable>;

/// η_m of a perfectly reflecting groove (R = 1): the share of the incident power that goes to `order`. In [0, 1].
/// Scalar theory at normal incidence, phase φ = 4π depth/λ (PHYSICS §3; Goodman, Introduction to Fourier Optics, §4.4).
/// A table's share is table_efficiency() for light from s_g: what its metal takes is already gone.
/// pitch_nm > 0, wavelength_nm > 0, |s_g| ≤ 1.
double profile_efficiency(const Profile& profile, double pitch_nm, int order, double wavelength_nm, double s_g = 0.0);

/// True if η_m depends on where the light comes from: a table of several incidences.
bool depends_on_incidence(const Profile& profile);

/// The groove's own spectrum |∫ t(y) exp(−2πi x y) dy|² over one pitch at the fractional order x = d u/λ. At every
/// integer x it equals profile_efficiency(); between, it takes η_m's place where few grooves make orders wide. A table
/// has no groove and must not be asked.
double groove_spectrum(const Profile& profile, double pitch_nm, double fractional_order, double wavelength_nm);

/// sin(πx)/(πx), 1 at 0.
double sinc(double x);

}  // namespace rowland::diffraction

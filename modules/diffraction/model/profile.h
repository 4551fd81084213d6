#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace rowland::diffraction {

/// The efficiencies of one angle of incidence: a row per wavelength, a column per order of the table.
struct EfficiencySlice {
    double incidence_deg = 0.0;          ///< signed: positive where the light comes from +g, s_g = sin(incidence)
    std::vector<double> wavelengths_nm;  ///< ascending, at least one
    std::vector<double> efficiencies;    ///< row by row, each ≥ 0, rows summing to at most 1 + kRowSumTolerance
};

/// Order efficiencies from a measurement or a rigorous solver; they include the metal (PHYSICS §3).
struct EfficiencyTable {
    static constexpr std::string_view kName = "table";  ///< `type` in a material file

    std::vector<int> orders;              ///< ascending; all others are 0
    std::vector<EfficiencySlice> slices;  ///< ascending incidence, at least one
};

/// How far a row's sum may exceed 1 by rounding; such rows are scaled to 1.
inline constexpr double kRowSumTolerance = 1e-3;

/// η_m(λ) for light from s_g, |s_g| ≤ 1. Linear in wavelength, and in the angle of incidence if the table has several;
/// constant beyond the table's ends.
///
/// Never interpolated across a cut-off. An order is cut off after its last non-zero row if zeros follow: the value of
/// that row holds up to the wavelength λ_c at which the order turns evanescent, d (1 ± s_g)/|m|, or up to the next row
/// if λ_c is not between the two; beyond, the value is 0. A row at λ_c itself is ignored: solvers print 0 or the limit
/// there. Between a slice that has the order and one that has not, the former's value holds while the order propagates.
/// Held values are no means of rows, so the orders may sum to more than 1: then all are scaled to a sum of 1.
double table_efficiency(const EfficiencyTable& table, double pitch_nm, int order, double wavelength_nm, double s_g);

/// A slit of width b in every pitch d (Agu's groove).
struct SlitProfile {
    static constexpr std::string_view kName = "slit";

    double width_nm = 0.0;  ///< 0 < b ≤ pitch
};

/// A rectangular groove: the fraction `duty` of the pitch is raised by `depth_nm`.
struct LamellarProfile {
    static constexpr std::string_view kName = "lamellar";

    double duty = 0.5;  ///< 0 < w < 1
    double depth_nm = 0.0;

    friend bool operator==(const LamellarProfile&, const LamellarProfile&) = default;
};

/// A sinusoidal groove; the depth is peak to peak.
struct SinusoidalProfile {
    static constexpr std::string_view kName = "sinusoidal";

    double depth_nm = 0.0;

    friend bool operator==(const SinusoidalProfile&, const SinusoidalProfile&) = default;
};

/// A linear ramp whose depth grows toward +g: it favours orders m > 0.
struct BlazedProfile {
    static constexpr std::string_view kName = "blazed";

    double depth_nm = 0.0;

    friend bool operator==(const BlazedProfile&, const BlazedProfile&) = default;
};

/// The shape of a groove. A new one also needs, in profile.cpp, the overloads efficiency(), spectrum() and describe()
/// (it does not compile without), and its descriptor, from which parser, schema and editors take it.
using Profile = std::variant<SlitProfile, LamellarProfile, SinusoidalProfile, BlazedProfile, EfficiencyTable>;

/// One member of a profile in a material file: a number greater than 0, or the name of a file.
struct ProfileMember {
    const char* key = "";       ///< in the file; profiles may have a key in common, which then means the same
    const char* label = "";     ///< in a user interface; with the unit the title in the schema
    const char* unit = "";      ///< "" for a pure number
    double less_than = 0.0;     ///< values lie in (0, less_than); infinity: no upper limit
    bool within_pitch = false;  ///< values lie in (0, pitch_nm] instead
    double initial = 0.0;       ///< when a user chooses the profile; the schema's default
    const char* help = "";
    const char* source = "";  ///< of the formula
    /// Returns the number in a Profile that holds the profile described. Null: the member names the file that the
    /// profile is read from.
    double& (*value)(Profile&) = nullptr;
};

/// A profile as files and user interfaces know it.
struct ProfileDescriptor {
    std::string_view name;  ///< kName
    Profile empty;          ///< the profile described, its numbers not set
    std::vector<ProfileMember> members;
};

/// One descriptor per profile, in the order of the variant.
std::span<const ProfileDescriptor> profile_descriptors();

/// η_m of a perfectly reflecting groove (R = 1): the fraction of the incident power that goes to `order`. In [0, 1].
/// Scalar theory at normal incidence, phase φ = 4π depth/λ (PHYSICS §3; Goodman, Introduction to Fourier Optics, §4.4).
/// Of a table: table_efficiency() for light from s_g, which includes the metal's absorption.
/// pitch_nm > 0, wavelength_nm > 0, |s_g| ≤ 1.
double profile_efficiency(const Profile& profile, double pitch_nm, int order, double wavelength_nm, double s_g = 0.0);

/// True if η_m depends on where the light comes from: a table of several incidences.
bool depends_on_incidence(const Profile& profile);

/// The groove's own spectrum |∫ t(y) exp(−2πi x y) dy|² over one pitch at the fractional order x = d u/λ. At every
/// integer x it equals profile_efficiency(); between, it replaces η_m where few grooves make orders wide. A table has
/// no groove: a contract violation.
double groove_spectrum(const Profile& profile, double pitch_nm, double fractional_order, double wavelength_nm);

/// sin(πx)/(πx), 1 at 0.
double sinc(double x);

}  // namespace rowland::diffraction

#include "modules/diffraction/model/profile.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <optional>
#include <type_traits>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

constexpr double kRadian_deg = 180.0 / std::numbers::pi;

/// The longest wavelength at which the order propagates for light from s_g: |mλ/d − s_g| = 1.
double cut_off_nm(double pitch_nm, int order, double s_g) {
    if (order == 0) return std::numeric_limits<double>::infinity();
    return pitch_nm * (1.0 + (order > 0 ? s_g : -s_g)) / std::abs(order);
}

/// The efficiency of one order in one slice; none where the order is cut off.
std::optional<double> slice_efficiency(const EfficiencyTable& table, const EfficiencySlice& slice, std::size_t column,
                                       double pitch_nm, double wavelength_nm) {
    const std::vector<double>& rows_nm = slice.wavelengths_nm;
    const auto value = [&](std::size_t row) { return slice.efficiencies[row * table.orders.size() + column]; };
    const double cut_nm = cut_off_nm(pitch_nm, table.orders[column], std::sin(slice.incidence_deg / kRadian_deg));
    // Rows that are 0, or at the cut-off within the digits of a file, end the column.
    std::size_t count = rows_nm.size();
    while (count > 0 && (value(count - 1) == 0.0 || std::abs(rows_nm[count - 1] - cut_nm) < 1e-6 * rows_nm[count - 1]))
        --count;
    if (count == 0) return std::nullopt;
    if (const double last_nm = rows_nm[count - 1]; wavelength_nm >= last_nm) {
        const double next_nm = count < rows_nm.size() ? rows_nm[count] : std::numeric_limits<double>::infinity();
        const double holds_to_nm = cut_nm > last_nm ? std::min(next_nm, cut_nm) : next_nm;
        return wavelength_nm < holds_to_nm ? std::optional(value(count - 1)) : std::nullopt;
    }
    if (wavelength_nm <= rows_nm.front()) return value(0);
    const auto above = std::upper_bound(rows_nm.begin(), rows_nm.end(), wavelength_nm);
    const auto i = static_cast<std::size_t>(above - rows_nm.begin());
    return std::lerp(value(i - 1), value(i), (wavelength_nm - rows_nm[i - 1]) / (rows_nm[i] - rows_nm[i - 1]));
}

/// One column's value, before the orders are scaled to a sum of 1.
double unscaled_efficiency(const EfficiencyTable& table, std::size_t column, double pitch_nm, double wavelength_nm,
                           double s_g) {
    const auto of_slice = [&](const EfficiencySlice& slice) {
        return slice_efficiency(table, slice, column, pitch_nm, wavelength_nm);
    };
    const double incidence_deg = kRadian_deg * std::asin(std::clamp(s_g, -1.0, 1.0));
    const auto above = std::find_if(table.slices.begin(), table.slices.end(),
                                    [&](const EfficiencySlice& slice) { return slice.incidence_deg > incidence_deg; });
    if (above == table.slices.begin()) return of_slice(table.slices.front()).value_or(0.0);
    if (above == table.slices.end()) return of_slice(table.slices.back()).value_or(0.0);
    const EfficiencySlice& below = *(above - 1);
    const std::optional<double> first = of_slice(below);
    const std::optional<double> second = of_slice(*above);
    const double t = (incidence_deg - below.incidence_deg) / (above->incidence_deg - below.incidence_deg);
    if (first && second) return std::lerp(*first, *second, t);
    if (t == 0.0) return first.value_or(0.0);
    const bool propagates = wavelength_nm < cut_off_nm(pitch_nm, table.orders[column], s_g);
    return propagates ? first.value_or(second.value_or(0.0)) : 0.0;
}

}  // namespace

double table_efficiency(const EfficiencyTable& table, double pitch_nm, int order, double wavelength_nm, double s_g) {
    const auto found = std::lower_bound(table.orders.begin(), table.orders.end(), order);
    if (found == table.orders.end() || *found != order) return 0.0;
    double sum = 0.0;
    for (std::size_t column = 0; column < table.orders.size(); ++column)
        sum += unscaled_efficiency(table, column, pitch_nm, wavelength_nm, s_g);
    const auto column = static_cast<std::size_t>(found - table.orders.begin());
    return unscaled_efficiency(table, column, pitch_nm, wavelength_nm, s_g) / std::max(sum, 1.0);
}

namespace {

using std::numbers::pi;

/// sin(πx), exactly 0 at whole x.
double sin_pi(double x) {
    const double whole = std::round(x);
    const double sine = std::sin(pi * (x - whole));
    return std::fmod(whole, 2.0) == 0.0 ? sine : -sine;
}

double square(double x) {
    return x * x;
}

/// J_order(z), order ≥ 0, by POSIX, as std::cyl_bessel_j of libstdc++ gives no number at high orders or from z = 1000
/// on.
double bessel_j(int order, double z) {
    return ::jn(order, z);
}

/// Phase φ between light from the top and from the bottom of a groove, in turns, at normal incidence and diffraction.
double phase_turns(double depth_nm, double wavelength_nm) {
    return 2.0 * depth_nm / wavelength_nm;
}

double efficiency(const SlitProfile& slit, double pitch_nm, int order, double, double) {
    const double fill = slit.width_nm / pitch_nm;
    return square(fill * sinc(order * fill));
}

double efficiency(const LamellarProfile& lamellar, double, int order, double wavelength_nm, double) {
    const double w = lamellar.duty;
    const double sine_squared = square(sin_pi(phase_turns(lamellar.depth_nm, wavelength_nm)));
    if (order == 0) return 1.0 - 4.0 * w * (1.0 - w) * sine_squared;
    return 4.0 * square(w * sinc(order * w)) * sine_squared;
}

double efficiency(const SinusoidalProfile& sinusoidal, double, int order, double wavelength_nm, double) {
    return square(bessel_j(std::abs(order), pi * phase_turns(sinusoidal.depth_nm, wavelength_nm)));
}

double efficiency(const BlazedProfile& blazed, double, int order, double wavelength_nm, double) {
    return square(sinc(phase_turns(blazed.depth_nm, wavelength_nm) - order));
}

double efficiency(const EfficiencyTable& table, double pitch_nm, int order, double wavelength_nm, double s_g) {
    return table_efficiency(table, pitch_nm, order, wavelength_nm, s_g);
}

double spectrum(const SlitProfile& slit, double pitch_nm, double x, double) {
    const double fill = slit.width_nm / pitch_nm;
    return square(fill * sinc(x * fill));
}

double spectrum(const LamellarProfile& lamellar, double, double x, double wavelength_nm) {
    // The flat period plus the change by the raised part; both are centred on the same line.
    const double w = lamellar.duty;
    const double phase = 2.0 * pi * phase_turns(lamellar.depth_nm, wavelength_nm);
    return std::norm(sinc(x) + (std::polar(1.0, phase) - 1.0) * (w * sinc(x * w)));
}

double spectrum(const SinusoidalProfile& sinusoidal, double, double x, double wavelength_nm) {
    // Jacobi–Anger: exp(iz cos θ) = Σ_k i^k J_k(z) exp(ikθ). J_k is below 1e-16 from k = z + 6 z^⅓ + 16 on.
    const double z = pi * phase_turns(sinusoidal.depth_nm, wavelength_nm);
    const int last = static_cast<int>(z + 6.0 * std::cbrt(z)) + 16;
    std::complex<double> sum = bessel_j(0, z) * sinc(x);
    std::complex<double> power = 1.0;
    for (int k = 1; k <= last; ++k) {
        power *= std::complex<double>(0.0, 1.0);
        sum += power * (bessel_j(k, z) * (sinc(x - k) + sinc(x + k)));
    }
    return std::norm(sum);
}

double spectrum(const BlazedProfile& blazed, double, double x, double wavelength_nm) {
    return square(sinc(phase_turns(blazed.depth_nm, wavelength_nm) - x));
}

double spectrum(const EfficiencyTable&, double, double, double) {
    ROWLAND_CHECK(false, "a table of efficiencies has no groove spectrum");
    return 0.0;
}

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
const char* const kScalar = "Goodman, Introduction to Fourier Optics, ch. 4: scalar theory at normal incidence";

/// The number that a member of a profile's struct holds.
template <typename Shape, double Shape::*Number>
double& number(Profile& profile) {
    return std::get<Shape>(profile).*Number;
}

template <typename Shape>
ProfileMember depth(double initial_nm) {
    return {.key = "depth_nm",
            .label = "Groove depth",
            .unit = "nm",
            .less_than = kUnlimited,
            .initial = initial_nm,
            .help = "Depth of a groove, from top to bottom; above 0. Light from the bottom is late by 4π depth/λ.",
            .source = kScalar,
            .value = &number<Shape, &Shape::depth_nm>};
}

ProfileDescriptor describe(const SlitProfile& slit) {
    return {.name = SlitProfile::kName,
            .empty = slit,
            .members = {{.key = "width_nm",
                         .label = "Slit width",
                         .unit = "nm",
                         .within_pitch = true,
                         .initial = 800.0,
                         .help = "Width b of the part of a groove that reflects; above 0, at most the pitch. "
                                 "η_m = (b/d)² sinc²(m b/d).",
                         .source = "Lindsay & Agu 2006, eq. 2",
                         .value = &number<SlitProfile, &SlitProfile::width_nm>}}};
}

ProfileDescriptor describe(const LamellarProfile& lamellar) {
    return {.name = LamellarProfile::kName,
            .empty = lamellar,
            .members = {{.key = "duty",
                         .label = "Duty",
                         .less_than = 1.0,
                         .initial = 0.5,
                         .help = "Fraction w of the pitch that is raised; between 0 and 1. "
                                 "η_m = 4w² sinc²(m w) sin²(φ/2), φ = 4π depth/λ.",
                         .source = kScalar,
                         .value = &number<LamellarProfile, &LamellarProfile::duty>},
                        depth<LamellarProfile>(150.0)}};
}

ProfileDescriptor describe(const SinusoidalProfile& sinusoidal) {
    return {.name = SinusoidalProfile::kName, .empty = sinusoidal, .members = {depth<SinusoidalProfile>(150.0)}};
}

ProfileDescriptor describe(const BlazedProfile& blazed) {
    return {.name = BlazedProfile::kName, .empty = blazed, .members = {depth<BlazedProfile>(250.0)}};
}

ProfileDescriptor describe(const EfficiencyTable& table) {
    return {.name = EfficiencyTable::kName,
            .empty = table,
            .members = {{.key = "file",
                         .label = "Table",
                         .help = "CSV beside the material: wavelength_nm,R-2,R-1,R+0,R+1,… It includes the metal.",
                         .source = "a measurement, or a rigorous solver"}}};
}

template <typename... Shapes>
std::vector<ProfileDescriptor> describe_all(std::type_identity<std::variant<Shapes...>>) {
    return {describe(Shapes{})...};
}

}  // namespace

std::span<const ProfileDescriptor> profile_descriptors() {
    static const std::vector<ProfileDescriptor> descriptors = describe_all(std::type_identity<Profile>{});
    return descriptors;
}

double sinc(double x) {
    return std::abs(x) < 1e-8 ? 1.0 : sin_pi(x) / (pi * x);
}

double profile_efficiency(const Profile& profile, double pitch_nm, int order, double wavelength_nm, double s_g) {
    return std::visit([&](const auto& shape) { return efficiency(shape, pitch_nm, order, wavelength_nm, s_g); },
                      profile);
}

bool depends_on_incidence(const Profile& profile) {
    const auto* table = std::get_if<EfficiencyTable>(&profile);
    return table != nullptr && table->slices.size() > 1;
}

double groove_spectrum(const Profile& profile, double pitch_nm, double fractional_order, double wavelength_nm) {
    return std::visit([&](const auto& shape) { return spectrum(shape, pitch_nm, fractional_order, wavelength_nm); },
                      profile);
}

}  // namespace rowland::diffraction

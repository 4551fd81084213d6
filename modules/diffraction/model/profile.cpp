#include "modules/diffraction/model/profile.h"

#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <type_traits>

#include "engine/core/check.h"

namespace rowland::diffraction {

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

/// J_order(z), order ≥ 0. By POSIX: std::cyl_bessel_j of libstdc++ is not a number at high orders, nor from z = 1000
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
            .slider_least = 10.0,
            .slider_most = 1000.0,
            .initial = initial_nm,
            .help = "Depth of a groove, from top to bottom; above 0. Light from the bottom is late by 4π depth/λ.",
            .source = kScalar,
            .value = &number<Shape, &Shape::depth_nm>};
}

ProfileDescriptor describe(const SlitProfile& slit) {
    return {.name = "slit",
            .empty = slit,
            .members = {{.key = "width_nm",
                         .label = "Slit width",
                         .unit = "nm",
                         .within_pitch = true,
                         .slider_least = 10.0,
                         .slider_most = 2000.0,
                         .initial = 800.0,
                         .help = "Width b of the part of a groove that reflects; above 0, at most the pitch. "
                                 "η_m = (b/d)² sinc²(m b/d).",
                         .source = "Lindsay & Agu 2006, eq. 2",
                         .value = &number<SlitProfile, &SlitProfile::width_nm>}}};
}

ProfileDescriptor describe(const LamellarProfile& lamellar) {
    return {.name = "lamellar",
            .empty = lamellar,
            .members = {{.key = "duty",
                         .label = "Duty",
                         .less_than = 1.0,
                         .slider_least = 0.02,
                         .slider_most = 0.98,
                         .initial = 0.5,
                         .help = "Fraction w of the pitch that is raised; between 0 and 1. "
                                 "η_m = 4w² sinc²(m w) sin²(φ/2), φ = 4π depth/λ.",
                         .source = kScalar,
                         .value = &number<LamellarProfile, &LamellarProfile::duty>},
                        depth<LamellarProfile>(150.0)}};
}

ProfileDescriptor describe(const SinusoidalProfile& sinusoidal) {
    return {.name = "sinusoidal", .empty = sinusoidal, .members = {depth<SinusoidalProfile>(150.0)}};
}

ProfileDescriptor describe(const BlazedProfile& blazed) {
    return {.name = "blazed", .empty = blazed, .members = {depth<BlazedProfile>(250.0)}};
}

ProfileDescriptor describe(const EfficiencyTable& table) {
    return {.name = "table",
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

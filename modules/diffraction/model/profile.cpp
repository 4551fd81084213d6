#include "modules/diffraction/model/profile.h"

#include <cmath>
#include <complex>
#include <numbers>

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
    return square(std::cyl_bessel_j(std::abs(order), pi * phase_turns(sinusoidal.depth_nm, wavelength_nm)));
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
    // The flat period plus what the raised share changes, both centred on the same line.
    const double w = lamellar.duty;
    const double phase = 2.0 * pi * phase_turns(lamellar.depth_nm, wavelength_nm);
    return std::norm(sinc(x) + (std::polar(1.0, phase) - 1.0) * (w * sinc(x * w)));
}

double spectrum(const SinusoidalProfile& sinusoidal, double, double x, double wavelength_nm) {
    // Jacobi–Anger: exp(iz cos θ) = Σ_k i^k J_k(z) exp(ikθ). J_k is below 1e-16 from k = z + 6 z^⅓ + 16 on.
    const double z = pi * phase_turns(sinusoidal.depth_nm, wavelength_nm);
    const int last = static_cast<int>(z + 6.0 * std::cbrt(z)) + 16;
    std::complex<double> sum = std::cyl_bessel_j(0, z) * sinc(x);
    std::complex<double> power = 1.0;
    for (int k = 1; k <= last; ++k) {
        power *= std::complex<double>(0.0, 1.0);
        sum += power * (std::cyl_bessel_j(k, z) * (sinc(x - k) + sinc(x + k)));
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

}  // namespace

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

#include "modules/diffraction/model/brdf.h"

#include <cmath>
#include <numbers>

#include "engine/colour/spectrum.h"
#include "engine/core/check.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

std::optional<double> diffracted_cosine(double s_g, int order, double wavelength_nm, double pitch_nm) {
    const double v_g = order * wavelength_nm / pitch_nm - s_g;
    if (std::abs(v_g) > 1.0) return std::nullopt;
    return v_g;
}

bool propagates(int order, double wavelength_nm, double pitch_nm) {
    return std::abs(order) * wavelength_nm < 2.0 * pitch_nm;
}

std::vector<Peak> visible_peaks(double u, double pitch_nm, std::span<const int> orders) {
    std::vector<Peak> peaks;
    for (const int order : orders) {
        if (order == 0) continue;
        const double wavelength_nm = pitch_nm * u / order;
        if (wavelength_nm >= colour::kVisibleMin && wavelength_nm <= colour::kVisibleMax)
            peaks.push_back({order, wavelength_nm});
    }
    return peaks;
}

std::vector<int> all_orders(double pitch_nm) {
    const int highest = static_cast<int>(std::ceil(2.0 * pitch_nm / colour::kVisibleMin)) - 1;
    std::vector<int> orders;
    for (int order = -highest; order <= highest; ++order)
        if (order != 0) orders.push_back(order);
    return orders;
}

namespace {

template <typename T>
T fejer_ratio(T grooves, T delta) {
    constexpr T pi = std::numbers::pi_v<T>;
    const T period_delta = delta - std::round(delta);
    const T phase = grooves * period_delta;
    // Series about the peak: sin(Nx)/(N sin x) = 1 − (N²−1)x²/6 + O((Nx)⁴); below 1e-4 the remainder is below 1e-16.
    if (std::abs(phase) < T(1e-4)) {
        const T x = pi * period_delta;
        const T ratio = T(1) - (grooves - T(1)) * (grooves + T(1)) * x * x / T(6);
        return ratio * ratio;
    }
    // N·δ modulo 1 before the sine; the product's rounding error is added back.
    const T rounding = std::fma(grooves, period_delta, -phase);
    const T folded = (phase - std::round(phase)) + rounding;
    const T ratio = std::sin(pi * folded) / (grooves * std::sin(pi * period_delta));
    return ratio * ratio;
}

}  // namespace

double fejer(double grooves, double delta) {
    return fejer_ratio(grooves, delta);
}
float fejer(float grooves, float delta) {
    return fejer_ratio(grooves, delta);
}

double brdf_agu(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm,
                double peak_intensity) {
    const auto* slit = std::get_if<SlitProfile>(&grating.profile);
    ROWLAND_CHECK(slit != nullptr, "Agu's BRDF is for slits");
    const double u = s.x + v.x;
    const double fractional_order = grating.pitch_nm * u / wavelength_nm;
    const double envelope = sinc(slit->width_nm * u / wavelength_nm);
    return peak_intensity * envelope * envelope *
           fejer(grating.grooves, fractional_order - std::round(fractional_order));
}

double path_density(const Grating& grating, double path_nm, double wavelength_nm, double s_g) {
    const double fractional_order = path_nm / wavelength_nm;
    const double nearest = std::round(fractional_order);
    const int order = static_cast<int>(nearest);
    if (!lists(grating, order) || !propagates(order, wavelength_nm, grating.pitch_nm)) return 0.0;
    const double efficiency = grating.grooves >= kManyGrooves
                                  ? order_efficiency(grating, order, wavelength_nm, s_g)
                                  : fractional_order_efficiency(grating, fractional_order, wavelength_nm);
    return efficiency * grating.grooves / wavelength_nm * fejer(grating.grooves, fractional_order - nearest);
}

double brdf_energy(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm) {
    const double s_n = grating.transmission ? -s.z : s.z;
    if (s_n <= 0.0 || v.z <= 0.0) return 0.0;
    return grating.pitch_nm * path_density(grating, grating.pitch_nm * (s.x + v.x), wavelength_nm, s.x) *
           lobe_density(grating.lobe, s.y + v.y, wavelength_nm) * transmittance(grating.cover, s_n) *
           transmittance(grating.cover, v.z);
}

}  // namespace rowland::diffraction

#include "modules/diffraction/model/brdf.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/fejer.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::diffraction {

namespace {

const SlitProfile& slit_of(const Grating& grating) {
    const auto* slit = std::get_if<SlitProfile>(&grating.profile);
    ROWLAND_CHECK(slit != nullptr, "Agu's BRDF is for slits");
    return *slit;
}

}  // namespace

double brdf_agu(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm,
                double peak_intensity) {
    const double u = s.x + v.x;
    const double fractional_order = grating.pitch_nm * u / wavelength_nm;
    const double envelope = sinc(slit_of(grating).width_nm * u / wavelength_nm);
    return peak_intensity * envelope * envelope *
           fejer(grating.grooves, fractional_order - std::round(fractional_order));
}

double brdf_energy(const Grating& grating, const glm::dvec3& s, const glm::dvec3& v, double wavelength_nm) {
    if (s.z <= 0.0 || v.z <= 0.0) return 0.0;
    const double fractional_order = grating.pitch_nm * (s.x + v.x) / wavelength_nm;
    const double nearest = std::round(fractional_order);
    const int order = static_cast<int>(nearest);
    if (std::find(grating.orders.begin(), grating.orders.end(), order) == grating.orders.end()) return 0.0;
    if (!propagates(order, wavelength_nm, grating.pitch_nm)) return 0.0;
    const double efficiency = grating.grooves >= kManyGrooves
                                  ? order_efficiency(grating, order, wavelength_nm, s.x)
                                  : fractional_order_efficiency(grating, fractional_order, wavelength_nm);
    return efficiency * grating.grooves * grating.pitch_nm / wavelength_nm *
           fejer(grating.grooves, fractional_order - nearest) * lobe_density(grating.lobe, s.y + v.y, wavelength_nm);
}

double agu_to_energy_ratio(const Grating& grating, double wavelength_nm) {
    const double fill = slit_of(grating).width_nm / grating.pitch_nm;
    return 2.0 * wavelength_nm / (grating.grooves * grating.pitch_nm * fill * fill);
}

}  // namespace rowland::diffraction

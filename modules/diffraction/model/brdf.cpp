#include "modules/diffraction/model/brdf.h"

#include <cmath>

#include "engine/core/check.h"
#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/model/fejer.h"
#include "modules/diffraction/model/grating_equation.h"

namespace rowland::diffraction {

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

#include "modules/diffraction/model/grating_equation.h"

#include <cmath>

#include "engine/colour/sampled_spectrum.h"

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

}  // namespace rowland::diffraction

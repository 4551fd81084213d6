// Gratings whose efficiencies come as tables.
#include <algorithm>

#include "modules/diffraction/model/efficiency.h"
#include "modules/diffraction/reference/reference.h"
#include "tests/property/generators.h"

namespace rowland::property {
namespace {

using namespace diffraction;

/// Efficiencies at one wavelength that sum to 1 or less; sometimes an order is cut off.
std::vector<double> any_row(std::size_t orders) {
    std::vector<double> row;
    for (std::size_t i = 0; i < orders; ++i) row.push_back(*whole(0, 4) == 0 ? 0.0 : *uniform(0.0, 1.0));
    double sum = 0.0;
    for (const double efficiency : row) sum += efficiency;
    const double all = *rc::gen::oneOf(uniform(0.0, 1.0), rc::gen::element(1.0));
    for (double& efficiency : row) efficiency = sum > 0.0 ? efficiency * all / sum : 0.0;
    return row;
}

EfficiencySlice any_slice(double incidence_deg, std::size_t orders) {
    EfficiencySlice slice{.incidence_deg = incidence_deg, .wavelengths_nm = {}, .efficiencies = {}};
    double wavelength_nm = *uniform(300.0, 500.0);
    for (int rows = *whole(1, 6); rows > 0; --rows) {
        slice.wavelengths_nm.push_back(wavelength_nm);
        const std::vector<double> row = any_row(orders);
        slice.efficiencies.insert(slice.efficiencies.end(), row.begin(), row.end());
        wavelength_nm += *log_uniform(0.1, 200.0);
    }
    return slice;
}

EfficiencyTable any_table() {
    EfficiencyTable table;
    for (int order = -4; order <= 4; ++order)
        if (*whole(0, 1) == 0) table.orders.push_back(order);
    if (table.orders.empty()) table.orders = {1};
    double incidence_deg = *uniform(-80.0, 0.0);
    for (int slices = *whole(1, 3); slices > 0; --slices) {
        table.slices.push_back(any_slice(incidence_deg, table.orders.size()));
        incidence_deg += *uniform(1.0, 40.0);
    }
    return table;
}

/// Between rows, between slices and where an order is held up to its cut-off: fractions of 1. 1e-14: rounding of the
/// sum.
RC_GTEST_PROP(TableProperty, OrdersShareThePower, ()) {
    const EfficiencyTable table = any_table();
    const double pitch_nm = *pitch();
    const double wavelength_nm = *rc::gen::oneOf(wavelength(), uniform(200.0, 1500.0));
    const double s_g = *rc::gen::oneOf(uniform(-1.0, 1.0), rc::gen::element(-1.0, 0.0, 1.0));
    double sum = 0.0;
    for (int order = -5; order <= 5; ++order) {
        const double efficiency = table_efficiency(table, pitch_nm, order, wavelength_nm, s_g);
        RC_ASSERT(std::isfinite(efficiency));
        RC_ASSERT(efficiency >= 0.0);
        sum += efficiency;
    }
    RC_ASSERT(sum <= 1.0 + 1e-14);
}

/// Uniform white light comes back as no more than itself from any side. Not so from a table that varies with the
/// incidence: a view gathers orders from several incidences, and nothing makes a table reciprocal; what such a one
/// sends out from each incidence is held above. 1e-6: the reference's quadrature of a lobe.
RC_GTEST_PROP(TableProperty, ReturnsNoMoreLightThanFallsIn, ()) {
    EfficiencyTable table = any_table();
    table.slices.resize(1);
    Grating shape;
    shape.pitch_nm = *rc::gen::oneOf(log_uniform(150.0, 5000.0), log_uniform(400.0, 2000.0));
    shape.profile = table;
    shape.orders = table.orders;
    if (*whole(0, 1) == 0) shape.lobe = GaussianLobe{*log_uniform(0.05, 3.0)};
    const lighting::ShLight white{1, {glm::dvec3(2.0 * std::sqrt(std::numbers::pi))}};
    const ShadingPoint frame{.view = *upper_direction(), .normal = {0.0, 0.0, 1.0}, .grating = {1.0, 0.0, 0.0}};
    const glm::dvec3 xyz = reference_radiance(shape, white, colour::LightSpectra(), std::span(&frame, 1)).front();
    RC_ASSERT(is_finite(xyz));
    RC_ASSERT(xyz.x >= 0.0 && xyz.y >= 0.0 && xyz.z >= 0.0);
    RC_ASSERT(xyz.y <= 1.0 + 1e-6);
}

}  // namespace
}  // namespace rowland::property

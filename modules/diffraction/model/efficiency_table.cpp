#include "modules/diffraction/model/efficiency_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

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

}  // namespace rowland::diffraction

#include "modules/diffraction/model/efficiency_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace rowland::diffraction {

namespace {

constexpr double kRadian_deg = 180.0 / std::numbers::pi;

/// The wavelength from which on the order is evanescent for light from s_g: |mλ/d − s_g| = 1.
double cut_off_nm(double pitch_nm, int order, double s_g) {
    if (order == 0) return std::numeric_limits<double>::infinity();
    return pitch_nm * (1.0 + (order > 0 ? s_g : -s_g)) / std::abs(order);
}

/// One order's column in one slice.
class Column {
 public:
    Column(const EfficiencySlice& slice, std::size_t columns, std::size_t column, double cut_off)
        : slice_(slice), columns_(columns), column_(column), cut_off_nm_(cut_off), last_(slice.wavelengths_nm.size()) {
        while (last_ > 0 && (value(last_ - 1) == 0.0 || is_at_cut_off(last_ - 1))) --last_;
    }

    /// The efficiency, or nothing where the order is cut off.
    std::optional<double> at(double wavelength_nm) const {
        const auto& rows = slice_.wavelengths_nm;
        if (last_ == 0) return std::nullopt;
        if (wavelength_nm >= rows[last_ - 1]) {
            if (wavelength_nm >= end_nm()) return std::nullopt;
            return value(last_ - 1);
        }
        if (wavelength_nm <= rows.front()) return value(0);
        const auto above = std::upper_bound(rows.begin(), rows.end(), wavelength_nm);
        const auto i = static_cast<std::size_t>(above - rows.begin());
        return std::lerp(value(i - 1), value(i), (wavelength_nm - rows[i - 1]) / (rows[i] - rows[i - 1]));
    }

 private:
    double value(std::size_t row) const { return slice_.efficiencies[row * columns_ + column_]; }

    /// To the digits that a file prints a wavelength with.
    bool is_at_cut_off(std::size_t row) const {
        return std::abs(slice_.wavelengths_nm[row] - cut_off_nm_) < 1e-6 * slice_.wavelengths_nm[row];
    }

    /// Where the last row's value ends.
    double end_nm() const {
        const auto& rows = slice_.wavelengths_nm;
        const double next = last_ < rows.size() ? rows[last_] : std::numeric_limits<double>::infinity();
        return cut_off_nm_ > rows[last_ - 1] ? std::min(next, cut_off_nm_) : next;
    }

    const EfficiencySlice& slice_;
    std::size_t columns_;
    std::size_t column_;
    double cut_off_nm_;
    std::size_t last_;  ///< one past the last row that the order is not cut off in
};

std::optional<double> slice_efficiency(const EfficiencyTable& table, const EfficiencySlice& slice, std::size_t column,
                                       double pitch_nm, double wavelength_nm) {
    const double s_g = std::sin(slice.incidence_deg / kRadian_deg);
    return Column(slice, table.orders.size(), column, cut_off_nm(pitch_nm, table.orders[column], s_g))
        .at(wavelength_nm);
}

/// One column's value, before the orders' sum is looked at.
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
    const double share = (incidence_deg - below.incidence_deg) / (above->incidence_deg - below.incidence_deg);
    if (first && second) return std::lerp(*first, *second, share);
    if (share == 0.0) return first.value_or(0.0);
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

#include "modules/diffraction/model/efficiency_grid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rowland::diffraction {

namespace {

EfficiencyGrid::ViewCell cell_at(double position, int count) {
    const double inside = std::clamp(position, 0.0, count - 1.0);
    const auto low = static_cast<std::size_t>(std::min(inside, count - 2.0));
    return {low, inside - static_cast<double>(low)};
}

}  // namespace

EfficiencyGrid::ViewCell EfficiencyGrid::view_cell(double v_g) {
    return cell_at(0.5 * ((v_g + 1.0) * kViews - 1.0), kViews);
}

double EfficiencyGrid::at(int order, double wavelength_nm, double v_g) const {
    const auto found = std::lower_bound(orders.begin(), orders.end(), order);
    if (found == orders.end() || *found != order) return 0.0;
    const auto [row, t] = cell_at((wavelength_nm - colour::kVisibleMin) / kStep_nm, kWavelengths);
    const auto [view, s] = view_cell(v_g);
    const auto first = static_cast<std::size_t>(found - orders.begin()) * kWavelengths;
    const float* below = values.data() + (first + row) * kViews + view;
    const float* above = below + kViews;
    return std::lerp(std::lerp(below[0], below[1], s), std::lerp(above[0], above[1], s), t);
}

void EfficiencyGrid::set(std::size_t order_index, int row, std::span<const Sample> samples) {
    float* const to = values.data() + (order_index * kWavelengths + static_cast<std::size_t>(row)) * kViews;
    if (samples.empty()) return;
    std::size_t next = 0;
    for (int view = 0; view < kViews; ++view) {
        const double v_g = view_at(view);
        while (next < samples.size() && samples[next].v_g < v_g) ++next;
        const Sample& above = samples[std::min(next, samples.size() - 1)];
        const Sample& below = samples[next == 0 ? 0 : next - 1];
        const double extent = above.v_g - below.v_g;
        const double t = extent > 0.0 ? std::clamp((v_g - below.v_g) / extent, 0.0, 1.0) : 0.0;
        to[view] = static_cast<float>(std::lerp(below.efficiency, above.efficiency, t));
    }
}

EfficiencyGrid empty_grid(double pitch_nm, std::vector<int> orders) {
    EfficiencyGrid grid{.pitch_nm = pitch_nm, .orders = std::move(orders), .values = {}};
    grid.values.resize(grid.orders.size() * EfficiencyGrid::kWavelengths * EfficiencyGrid::kViews);
    return grid;
}

EfficiencyGrid efficiency_grid(const EfficiencyTable& table, double pitch_nm) {
    EfficiencyGrid grid = empty_grid(pitch_nm, table.orders);
    for (std::size_t i = 0; i < table.orders.size(); ++i)
        for (int row = 0; row < EfficiencyGrid::kWavelengths; ++row) {
            const double wavelength_nm = EfficiencyGrid::wavelength_at(row);
            std::vector<EfficiencyGrid::Sample> samples;
            for (int view = 0; view < EfficiencyGrid::kViews; ++view) {
                const double v_g = EfficiencyGrid::view_at(view);
                if (std::abs(table.orders[i] * wavelength_nm / pitch_nm - v_g) < 1.0)
                    samples.push_back({v_g, table_efficiency(table, pitch_nm, table.orders[i], wavelength_nm, v_g)});
            }
            grid.set(i, row, samples);
        }
    return grid;
}

}  // namespace rowland::diffraction

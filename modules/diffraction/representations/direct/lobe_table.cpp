#include "modules/diffraction/representations/direct/lobe_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace rowland::diffraction {

namespace {

/// Rows of 5.6°.
constexpr int kRows = 32;

double cell_centre(int cell, int cells) {
    return (cell + 0.5) / cells;
}

}  // namespace

glm::dvec3 LobeTable::at(double psi, double x_nm) const {
    const auto cell_at = [](double t, int cells) { return std::clamp(t * cells - 0.5, 0.0, cells - 1.0); };
    const double s = cell_at((x_nm - begin_nm) / (end_nm - begin_nm), columns);
    const double t = cell_at(psi / std::numbers::pi + 0.5, rows);
    const int column = std::min(static_cast<int>(s), columns - 2);
    const int row = std::min(static_cast<int>(t), rows - 2);
    const auto value = [&](int r, int c) {
        return glm::dvec3(
            values[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)]);
    };
    const double fs = s - column;
    const double ft = t - row;
    return (1.0 - ft) * ((1.0 - fs) * value(row, column) + fs * value(row, column + 1)) +
           ft * ((1.0 - fs) * value(row + 1, column) + fs * value(row + 1, column + 1));
}

double lobe_height(double concentration, double s_g, double s_n) {
    const double across = std::sqrt(std::max(1.0 - s_g * s_g, 1e-9));
    return mean_above_wide(std::clamp(s_n / across, -1.0, 1.0), concentration * across * across);
}

LobeTable make_lobe_table(const BlurredKernel& kernel, double pitch_nm, const lighting::KeyLight& light, int columns) {
    LobeTable table{
        .begin_nm = kernel.begin_nm, .end_nm = kernel.end_nm, .columns = columns, .rows = kRows, .values = {}};
    table.values.reserve(static_cast<std::size_t>(kRows) * static_cast<std::size_t>(columns));
    const DirectMaterial material{.pitch_nm = pitch_nm, .zero_order_xyz = glm::dmat3(0.0), .lobe = FlatLobe{}};
    lighting::KeyLight raised = light;
    for (int row = 0; row < kRows; ++row) {
        const double psi = (cell_centre(row, kRows) - 0.5) * std::numbers::pi;
        raised.direction = {std::sin(psi), 0.0, std::cos(psi)};
        const LightSpot spot = light_spot(raised, glm::dmat3(1.0));
        const double height = lobe_height(light.concentration, std::sin(psi), std::cos(psi));
        for (int column = 0; column < columns; ++column) {
            const double x = table.begin_nm + (table.end_nm - table.begin_nm) * cell_centre(column, columns);
            const DirectView view{.v_g = x / pitch_nm - std::sin(psi), .v_h = 0.0, .footprint = 0.0};
            table.values.emplace_back(direct_radiance(kernel, material, spot, view) / height);
        }
    }
    return table;
}

glm::dvec3 lobe_radiance(const LobeTable& table, const DirectMaterial& material, const lighting::KeyLight& light,
                         const glm::dmat3& world_to_tangent, const DirectView& view) {
    const LightSpot spot = light_spot(light, world_to_tangent);
    const glm::dvec3 axis = world_to_tangent * light.direction;
    const double s_g = std::clamp(axis.x, -1.0, 1.0);
    const double x = material.pitch_nm * (s_g + view.v_g);
    const double psi = std::asin(s_g);
    // Samples over the footprint with its variance, no farther apart than the width of the lobe.
    const double across2 = std::max(1.0 - s_g * s_g, 1e-9);
    const double deviation = std::sqrt(lighting::lobe_moments(light.concentration).variance_across * across2);
    const int taps =
        view.footprint > 0.0 ? std::clamp(static_cast<int>(std::ceil(view.footprint / deviation)), 2, 16) : 1;
    const double aside = taps > 1 ? material.pitch_nm * view.footprint / std::sqrt(1.0 - 1.0 / (taps * taps)) : 0.0;
    glm::dvec3 value(0.0);
    for (int i = 0; i < taps; ++i) value += table.at(psi, x + aside * ((2.0 * i + 1.0) / taps - 1.0)) / double(taps);
    return lobe_height(light.concentration, s_g, axis.z) * groove_factor(material.lobe, spot, view.v_h) * value;
}

}  // namespace rowland::diffraction

#include "modules/diffraction/representations/direct/lobe_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace rowland::diffraction {

namespace {

/// Of 3.6° to 7.2° of the angle whose sine is s_g.
constexpr int kRows = 32;
/// Footprints below this fraction of the lobe's width are left out.
constexpr double kNoFootprint = 1.0 / 16.0;

double cell_centre(int cell, int cells) {
    return (cell + 0.5) / cells;
}

double across_of(double s_g) {
    return std::sqrt(std::max(1.0 - s_g * s_g, 1e-9));
}

/// A direction in the plane of g and n whose s_g has the coordinate t.
glm::dvec3 raised_direction(double t) {
    const double diamond = 2.0 * t - 1.0;
    return glm::normalize(glm::dvec3(diamond, 0.0, 1.0 - std::abs(diamond)));
}

}  // namespace

glm::dvec3 LobeTable::at(double s_g, double x_nm) const {
    const auto cell_at = [](double t, int cells) { return std::clamp(t * cells - 0.5, 0.0, cells - 1.0); };
    const double s = cell_at((x_nm - begin_nm) / (end_nm - begin_nm), columns);
    const double t = cell_at(0.5 + 0.5 * s_g / (std::abs(s_g) + across_of(s_g)), rows);
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

double lobe_height(double concentration, double s_n) {
    const lighting::LobeMoments moments = lighting::lobe_moments(concentration);
    const double variance = (moments.variance_along - moments.variance_across) * s_n * s_n + moments.variance_across;
    return lighting::clamp_normal(moments.mean * s_n, std::sqrt(std::max(variance, 0.0))).mean;
}

LobeTable make_lobe_table(const BlurredKernel& kernel, double pitch_nm, const lighting::KeyLight& light, int columns) {
    LobeTable table{
        .begin_nm = kernel.begin_nm, .end_nm = kernel.end_nm, .columns = columns, .rows = kRows, .values = {}};
    table.values.reserve(static_cast<std::size_t>(kRows) * static_cast<std::size_t>(columns));
    const DirectMaterial material{.pitch_nm = pitch_nm, .zero_order_xyz = glm::dmat3(0.0), .lobe = FlatLobe{}};
    lighting::KeyLight raised = light;
    for (int row = 0; row < kRows; ++row) {
        raised.direction = raised_direction(cell_centre(row, kRows));
        const LightSpot spot = light_spot(raised, glm::dmat3(1.0));
        const double height = lobe_height(light.concentration, raised.direction.z);
        for (int column = 0; column < columns; ++column) {
            const double x = table.begin_nm + (table.end_nm - table.begin_nm) * cell_centre(column, columns);
            const DirectView view{.v_g = x / pitch_nm - raised.direction.x, .v_h = 0.0, .footprint = 0.0};
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
    // Samples over the footprint with its variance, no farther apart than the width of the lobe.
    const double deviation = std::sqrt(lighting::lobe_moments(light.concentration).variance_across) * across_of(s_g);
    const double widths = view.footprint / deviation;
    const int taps = widths > kNoFootprint ? std::clamp(static_cast<int>(std::ceil(widths)), 2, 16) : 1;
    const double aside = taps > 1 ? material.pitch_nm * view.footprint / std::sqrt(1.0 - 1.0 / (taps * taps)) : 0.0;
    glm::dvec3 value(0.0);
    for (int i = 0; i < taps; ++i) value += table.at(s_g, x + aside * ((2.0 * i + 1.0) / taps - 1.0)) / double(taps);
    return transmittance(material.cover, spot) * lobe_height(light.concentration, axis.z) *
           groove_factor(material.lobe, spot, view.v_h) * value;
}

}  // namespace rowland::diffraction

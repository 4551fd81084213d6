#include "modules/diffraction/representations/direct/lobe_table.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/direct/lobe_cosine.h"

namespace rowland::diffraction {

namespace {

constexpr int kRowsPerOctave = 2;
constexpr int kRows = kRowsPerOctave * kLobeTableOctaves;
/// Farther along g, half of a lobe is below the horizon.
constexpr double kSteepest = 0.9995;

double cell_centre(int cell, int cells) {
    return (cell + 0.5) / cells;
}

double row_coordinate(double s_g, double variance) {
    return 0.5 + std::copysign(std::log2(1.0 + variance / kLeastLobeVariance) / kLobeTableOctaves, s_g);
}

/// Variance of s_g.
double variance_of(const lighting::LobeMoments& moments, double s_g) {
    return moments.variance_across + (moments.variance_along - moments.variance_across) * s_g * s_g;
}

/// A light and a pixel that have a row's variance: the light farther along g or, if that does not suffice, a wider
/// pixel.
struct RowSetting {
    double s_g = 0.0;
    double footprint = 0.0;
};

RowSetting row_setting(const lighting::LobeMoments& moments, double t) {
    const double variance = kLeastLobeVariance * (std::exp2(std::abs(t - 0.5) * kLobeTableOctaves) - 1.0);
    const double wider = variance - moments.variance_across;
    if (wider >= 0.0) return {.s_g = 0.0, .footprint = std::sqrt(3.0 * wider)};
    const double s_g = std::sqrt(wider / (moments.variance_along - moments.variance_across));
    return {.s_g = std::copysign(std::min(s_g, kSteepest), t - 0.5), .footprint = 0.0};
}

/// Lowers the inner nodes of a row, so that linear interpolation is right on average.
void sharpen(std::span<glm::vec3> row) {
    glm::vec3 left = row[0];
    for (std::size_t i = 1; i + 1 < row.size(); ++i) {
        const glm::vec3 here = row[i];
        row[i] -= kBestLinear * (left - 2.0F * here + row[i + 1]);
        left = here;
    }
}

glm::dmat3 radiance_of(const BlurredKernel& kernel, double pitch_nm, std::span<const LobeWindow> windows, double v_g,
                       double footprint) {
    glm::dmat3 sum(0.0);
    for (const LobeWindow& window : windows) {
        const double deviation = std::hypot(window.deviation_g, footprint / std::sqrt(3.0));
        sum += 0.5 * window.cosine * pitch_nm * kernel.at(pitch_nm * (window.centre_g + v_g), pitch_nm * deviation);
    }
    return sum;
}

}  // namespace

glm::dvec3 LobeTable::at(double s_g, double variance, double x_nm) const {
    const auto cell_at = [](double t, int cells) { return std::clamp(t * cells - 0.5, 0.0, cells - 1.0); };
    const double s = cell_at((x_nm - begin_nm) / (end_nm - begin_nm), columns);
    const double t = cell_at(row_coordinate(s_g, variance), rows);
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
    return lighting::clamp_normal(moments.mean * s_n, std::sqrt(std::max(variance_of(moments, s_n), 0.0))).mean;
}

glm::dvec4 lobe_height_fit(double concentration) {
    const glm::dvec4 positions(0.0, 0.4, 1.1, 2.0);  // where it is exact, in deviations
    const lighting::LobeMoments moments = lighting::lobe_moments(concentration);
    const double unit = std::min(std::sqrt(moments.variance_across), moments.mean / positions.w);
    glm::dmat4 powers(1.0);
    glm::dvec4 logarithms(0.0);
    for (int i = 0; i < 4; ++i) {
        const double mean = unit * positions[i];
        for (int power = 0; power < 4; ++power) powers[power][i] = std::pow(positions[i], power);
        logarithms[i] = std::log2(lobe_height(concentration, mean / moments.mean) - mean);
    }
    return glm::inverse(powers) * logarithms / glm::dvec4(1.0, unit, unit * unit, unit * unit * unit);
}

LobeTable make_lobe_table(const BlurredKernel& kernel, double pitch_nm, const lighting::KeyLight& light, int columns) {
    LobeTable table{
        .begin_nm = kernel.begin_nm, .end_nm = kernel.end_nm, .columns = columns, .rows = kRows, .values = {}};
    table.values.reserve(static_cast<std::size_t>(kRows) * static_cast<std::size_t>(columns));
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    lighting::KeyLight raised = light;
    for (int row = 0; row < kRows; ++row) {
        const RowSetting setting = row_setting(moments, cell_centre(row, kRows));
        raised.direction = {setting.s_g, 0.0, std::sqrt(1.0 - setting.s_g * setting.s_g)};
        const std::vector<LobeWindow> windows = lobe_windows(LobeCosine(raised.direction, light.concentration));
        const double height = lobe_height(light.concentration, raised.direction.z);
        for (int column = 0; column < columns; ++column) {
            const double x = table.begin_nm + (table.end_nm - table.begin_nm) * cell_centre(column, columns);
            const double v_g = x / pitch_nm - moments.mean * setting.s_g;
            table.values.emplace_back(radiance_of(kernel, pitch_nm, windows, v_g, setting.footprint) * light.flux /
                                      height);
        }
        sharpen(std::span(table.values).last(static_cast<std::size_t>(columns)));
    }
    return table;
}

glm::dvec3 lobe_radiance(const LobeTable& table, const DirectMaterial& material, const lighting::KeyLight& light,
                         const glm::dmat3& world_to_tangent, const DirectView& view) {
    const LightSpot spot = light_spot(light, world_to_tangent);
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    const glm::dvec3 axis = world_to_tangent * light.direction;
    const double x = material.pitch_nm * (moments.mean * axis.x + view.v_g);
    const double variance = variance_of(moments, axis.x) + view.footprint * view.footprint / 3.0;
    return transmittance(material.cover, spot) * lobe_height(light.concentration, axis.z) *
           groove_factor(material.lobe, spot, view.v_h) * table.at(axis.x, variance, x);
}

}  // namespace rowland::diffraction

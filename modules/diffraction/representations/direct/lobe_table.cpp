#include "modules/diffraction/representations/direct/lobe_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <span>

#include "engine/math/quadrature.h"
#include "modules/diffraction/bake/kernel_cells.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// The least z of light_above_narrow().
constexpr double kClosedForm = 3.0;

/// From the middle of a lobe to either end, in deviations.
constexpr double kLobeReach = 4.5;

/// ∫₀^π sin t e^(z (cos(t − t₀) − 1)) dt for z ≥ 3, exact in the tails also. `sine` and `cosine`: of t₀, which lies in
/// (−π/2, π/2).
double light_above_narrow(double sine, double cosine, double z) {
    // With τ = t − t₀, sin t = sin τ cos t₀ + cos τ sin t₀: the first term has a closed integral, the second is normal
    // in y = 2√z sin(τ/2), to 1/z².
    const double root = std::sqrt(z);
    const auto gauss = [](double y) { return std::exp(-0.5 * y * y); };
    // 2 cos(t₀/2) and 2 sin(t₀/2) without cancellation.
    const double half_cosine = std::sqrt(2.0 + 2.0 * cosine);
    const double half_sine = 2.0 * sine / half_cosine;
    const double begin = -half_sine * root;
    const double end = half_cosine * root;
    const auto below = [](double y) { return 0.5 * std::erfc(-y / std::numbers::sqrt2); };
    const double above = begin > 0.0 ? below(-begin) - below(-end) : below(end) - below(begin);
    const double second = 3.0 / (8.0 * z);
    const double even =
        (std::sqrt(2.0 * pi) * above * (1.0 - second) + second * (end * gauss(end) - begin * gauss(begin))) / root;
    const double odd = (gauss(begin) - gauss(end)) / z;
    return std::max(0.0, cosine * odd + sine * even);
}

/// light_above_narrow() for smaller z.
double light_above_wide(double sine, double cosine, double z) {
    static const math::QuadratureRule rule = math::gauss_legendre(12, 0.0, pi);
    double sum = 0.0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double height = std::sin(rule.nodes[i]);
        const double along = std::cos(rule.nodes[i]) * cosine + height * sine;
        sum += rule.weights[i] * height * std::exp(z * (along - 1.0));
    }
    return sum;
}

}  // namespace

LobeCosine::LobeCosine(const glm::dvec3& axis, double concentration)
    : concentration_(concentration),
      across_(std::max(std::hypot(axis.y, axis.z), 1e-9)),
      sine_(axis.z / across_),
      cosine_(axis.y / across_),
      middle_(std::atan2(axis.x, across_)),
      scale_(concentration / (-2.0 * pi * std::expm1(-2.0 * concentration))) {}

double LobeCosine::operator()(double psi) const {
    const double cosine = std::cos(psi);
    const double half = std::sin(0.5 * (psi - middle_));
    const double z = concentration_ * cosine * across_;
    // sin t = sin(π − t), so t₀ may be taken in (−π/2, π/2).
    const double above =
        z < kClosedForm ? light_above_wide(sine_, cosine_, z) : light_above_narrow(sine_, std::abs(cosine_), z);
    return scale_ * cosine * cosine * std::exp(-2.0 * concentration_ * half * half) * above;
}

double LobeCosine::deviation() const {
    return 1.0 / std::sqrt(concentration_);
}

double LobeCosine::begin() const {
    return std::max(middle_ - kLobeReach * deviation(), -0.5 * pi);
}

double LobeCosine::end() const {
    return std::min(middle_ + kLobeReach * deviation(), 0.5 * pi);
}

std::vector<LobeSlice> lobe_slices(const LobeCosine& lobe, int count) {
    const double step = (lobe.end() - lobe.begin()) / count;
    std::vector<LobeSlice> slices;
    double begin_g = std::sin(lobe.begin());
    for (int i = 0; i < count; ++i) {
        const double end_g = std::sin(lobe.begin() + (i + 1) * step);
        slices.push_back({step * lobe(lobe.begin() + (i + 0.5) * step), begin_g, end_g});
        begin_g = end_g;
    }
    return slices;
}

std::vector<LobeWindow> lobe_windows(const LobeCosine& lobe) {
    constexpr int kSlices = 48;
    constexpr double kBetween = 0.7;  // fraction of the variance that lies between the windows
    constexpr std::array<double, 7> kNodes{-3.750439717725742, -2.366759410734541, -1.154405394739968, 0.0,
                                           1.154405394739968,  2.366759410734541,  3.750439717725742};
    constexpr std::array<double, 7> kWeights{5.48268855972218e-4, 3.07571239675865e-2, 2.40123178605013e-1,
                                             4.57142857142857e-1, 2.40123178605013e-1, 3.07571239675865e-2,
                                             5.48268855972218e-4};
    const double step = (lobe.end() - lobe.begin()) / kSlices;
    std::vector<LobeWindow> windows(kNodes.size());
    std::array<double, kNodes.size()> squares{};
    for (int slice = 0; slice < kSlices; ++slice) {
        const double psi = lobe.begin() + (slice + 0.5) * step;
        const double distance = (psi - lobe.middle()) / lobe.deviation();
        std::array<double, kNodes.size()> parts{};
        double whole = 0.0;
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const double from = distance - std::sqrt(kBetween) * kNodes[i];
            parts[i] = kWeights[i] * std::exp(-0.5 / (1.0 - kBetween) * from * from);
            whole += parts[i];
        }
        const double light = step * lobe(psi) / whole;
        const double s_g = std::sin(psi);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            windows[i].cosine += light * parts[i];
            windows[i].centre_g += light * parts[i] * s_g;
            squares[i] += light * parts[i] * s_g * s_g;
        }
    }
    for (std::size_t i = 0; i < windows.size(); ++i) {
        if (windows[i].cosine < 1e-30) continue;
        windows[i].centre_g /= windows[i].cosine;
        const double variance = squares[i] / windows[i].cosine - windows[i].centre_g * windows[i].centre_g;
        windows[i].deviation_g = std::sqrt(std::max(0.0, variance));
    }
    std::erase_if(windows, [](const LobeWindow& window) { return window.cosine < 1e-30; });
    return windows;
}

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

glm::dmat3 radiance_of(const BlurredKernel& kernel, std::span<const LobeWindow> windows, double v_g, double footprint) {
    const double pitch_nm = kernel.pitch_nm;
    glm::dmat3 sum(0.0);
    for (const LobeWindow& window : windows) {
        const double deviation = std::hypot(window.deviation_g, footprint / std::sqrt(3.0));
        sum +=
            0.5 * window.cosine * pitch_nm * kernel.at(pitch_nm * (window.centre_g + v_g), pitch_nm * deviation, v_g);
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

LobeTable make_lobe_table(const BlurredKernel& kernel, const lighting::KeyLight& light, int columns) {
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
            const double v_g = x / kernel.pitch_nm - moments.mean * setting.s_g;
            table.values.emplace_back(radiance_of(kernel, windows, v_g, setting.footprint) * light.flux / height);
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

#include "modules/diffraction/representations/circle/circle_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/math/quadrature.h"

namespace rowland::diffraction {

namespace {

glm::dvec3 mirrored(const glm::dvec3& v, int chart) {
    return chart == 0 ? v : glm::dvec3(v.x, -v.y, v.z);
}

}  // namespace

CircleFrame frame_at(const glm::dvec3& g, int chart) {
    const glm::dvec3 up = mirrored(g, chart);
    const glm::dvec3 bisector = up + glm::dvec3(0.0, 1.0, 0.0);
    const double scale = 1.0 / (1.0 + up.y);
    return {g, mirrored(glm::dvec3(1.0, 0.0, 0.0) - up.x * scale * bisector, chart),
            mirrored(glm::dvec3(0.0, 0.0, 1.0) - up.z * scale * bisector, chart)};
}

glm::dvec2 chart_point(const glm::dvec3& g, int chart) {
    const glm::dvec3 up = mirrored(g, chart);
    return glm::dvec2(up.x, up.z) / (1.0 + up.y);
}

AngleImage angle_image(std::size_t image) {
    AngleImage angle{1, 0};
    const auto reflect = [&](int quarters) { angle = {-angle.sign, quarters - angle.quarters}; };
    if ((image & 4) != 0) reflect(1);
    if ((image & 1) != 0) reflect(2);
    if ((image & 2) != 0) reflect(0);
    return angle;
}

glm::dvec3 grating_vector(const glm::dvec2& p, int chart) {
    const double square = glm::dot(p, p);
    return mirrored(glm::dvec3(2.0 * p.x, 1.0 - square, 2.0 * p.y) / (1.0 + square), chart);
}

namespace {

using std::numbers::pi;

/// Where a map is looked up.
struct CirclePosition {
    int chart;
    glm::dvec2 p;
    double v_g;
};

glm::dvec3 value_at(const CircleGrid& grid, int function, const CirclePosition& look_up) {
    const glm::dvec3 position((look_up.p * grid.scale() + 0.5) * static_cast<double>(grid.side) - 0.5,
                              0.5 * (look_up.v_g + 1.0) * (grid.views - 1));
    glm::dvec3 sum(0.0);
    const auto low = [](double at, int count) { return std::clamp(static_cast<int>(std::floor(at)), 0, count - 2); };
    const int column = low(position.x, grid.side);
    const int row = low(position.y, grid.side);
    const int view = low(position.z, grid.views);
    const glm::dvec3 t = glm::clamp(position - glm::dvec3(column, row, view), 0.0, 1.0);
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1;
        const int j = (corner >> 1) & 1;
        const int k = corner >> 2;
        const double weight = (i == 1 ? t.x : 1 - t.x) * (j == 1 ? t.y : 1 - t.y) * (k == 1 ? t.z : 1 - t.z);
        sum += weight * glm::dvec3(grid.xyz[grid.index(look_up.chart, function, view + k, row + j, column + i)]);
    }
    return sum;
}

/// The remainder of the series at the normal's angle, linear between two functions.
glm::dvec3 rest_at(const CircleMap& map, double c, double s, const CirclePosition& look_up) {
    const int count = map.remainder.functions;
    if (count == 0) return glm::dvec3(0.0);
    const double turns = map.covered ? circle_turn(c, s) : circle_turn(c * c - s * s, 2.0 * s * c);
    const double position = (turns - std::floor(turns)) * count;
    const int low = std::min(static_cast<int>(position), count - 1);
    const double second = position - low;
    return (1.0 - second) * value_at(map.remainder, low, look_up) +
           second * value_at(map.remainder, (low + 1) % count, look_up);
}

}  // namespace

std::size_t CircleGrid::index(int chart, int function, int view, int row, int column) const {
    const auto u = [](int i) { return static_cast<std::size_t>(i); };
    return (((u(chart) * u(functions) + u(function)) * u(views) + u(view)) * u(side) + u(row)) * u(side) + u(column);
}

int remainder_side(int side) {
    return std::max(8, side * 8 / 13);
}

int remainder_views(int views) {
    return std::max(8, views * 8 / 13);
}

CircleMapSize coarser(CircleMapSize size) {
    constexpr CircleMapSize kCoarse{.side = 16, .views = 40};
    return {
        .side = std::min(size.side, kCoarse.side), .views = std::min(size.views, kCoarse.views), .angles = size.angles};
}

int rest_angles(int angles, bool covered) {
    return covered ? 2 * angles : angles;
}

int circle_angles(const std::optional<Cover>& cover) {
    return cover ? 8 : 14;
}

std::array<double, kCircleMultiples> clamped_cosine(const std::optional<Cover>& cover, double r) {
    constexpr int kNodes = 32;
    static const math::QuadratureRule rule = math::gauss_legendre(kNodes, 0.0, 0.5 * pi);
    std::array<double, kCircleMultiples> series{};
    for (std::size_t node = 0; node < rule.nodes.size(); ++node) {
        const double t = rule.nodes[node];
        const double transmitted = cover ? transmittance(cover->ior, r * std::cos(t)) : 1.0;
        const double value = rule.weights[node] * transmitted * std::cos(t);
        for (std::size_t k = 0; k < series.size(); ++k)
            series[k] += (k == 0 ? 1.0 : 2.0) / pi * value * std::cos(static_cast<double>(k) * t);
    }
    return series;
}

double circle_turn(double c, double s) {
    const double y = (std::abs(c) - std::abs(s)) / (std::abs(c) + std::abs(s));
    const double from_axis = 0.125 + 0.125 * y * (1.2 - 0.2 * y * y);  // distance from the axis c = 0
    const double turn = c < 0.0 ? 0.25 + from_axis : 0.25 - from_axis;
    return s < 0.0 ? -turn : turn;
}

int chart_count(const KernelTable& kernel) {
    return is_even(kernel) ? 1 : 2;
}

glm::dvec3 sample(const CircleMap& map, const ShadingPoint& frame) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    const glm::dmat3 to_world = glm::transpose(to_tangent);
    const bool lower = to_world[0].y < 0.0;
    const double sign = lower && map.charts == 1 ? -1.0 : 1.0;
    const int chart = lower && map.charts == 2 ? 1 : 0;
    const CircleFrame at = frame_at(sign * to_world[0], chart);
    const CirclePosition look_up{chart, chart_point(at.g, chart), sign * v.x};
    const double c = glm::dot(to_world[2], at.e1);
    const double s = glm::dot(to_world[2], at.e2);
    const std::array<double, kCircleTerms> factors{1.0, c, s, c * c - s * s, 2.0 * s * c};
    glm::dvec3 sum = rest_at(map, c, s, look_up);
    for (int term = 0; term < kCircleTerms; ++term)
        sum += factors[static_cast<std::size_t>(term)] * value_at(map.terms, term, look_up);
    return sum;
}

}  // namespace rowland::diffraction

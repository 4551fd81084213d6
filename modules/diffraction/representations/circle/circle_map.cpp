#include "modules/diffraction/representations/circle/circle_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/math/quadrature.h"
#include "modules/diffraction/bake/kernel_cells.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

/// Side of the cube faces that the texels are gathered in: cells of 0.025 rad.
constexpr int kFaceSize = 64;

/// Terms of one sort that circles have in air and under a cover: on 1, cos t, cos 2t, cos 4t.
constexpr std::size_t kInAir = 4;

/// Fourier series of max(0, cos t) on 1, cos t, cos 2t, cos 4t, cos 6t.
constexpr std::array<double, 5> kClampedCosine{1.0 / pi, 0.5, 2.0 / (3.0 * pi), -2.0 / (15.0 * pi), 2.0 / (35.0 * pi)};

/// For each cell of a, what a cover's coefficients are over those that add_moments() has: in air, and 1 for cos 3t and
/// 5t; the last is of the lane without a term.
using CoverFactors = std::vector<std::array<float, 7>>;

CoverFactors cover_factors(const std::optional<Cover>& cover, int cells) {
    CoverFactors factors;
    for (int cell = 0; cover && cell < cells; ++cell) {
        const double a = 2.0 * (cell + 0.5) / cells - 1.0;
        const std::array<double, 6> series = covered_cosine(cover->ior, std::sqrt((1.0 - a) * (1.0 + a)));
        std::array<float, 7>& factor = factors.emplace_back();
        for (std::size_t k = 0; k < series.size(); ++k)
            factor[k] = static_cast<float>(k < kInAir ? series[k] / kClampedCosine[k] : series[k]);
    }
    return factors;
}

/// Multiplies moments in cells of a by the factors of their terms.
void apply(const CoverFactors& factors, std::size_t lanes, std::vector<float>& moments) {
    for (std::size_t i = 0; i < moments.size() && !factors.empty(); ++i)
        moments[i] *= factors[i / (3 * lanes)][(i % lanes + 1) / 2];
}

/// A grating vector and the directions from which angles around it are counted.
struct CircleFrame {
    glm::dvec3 g{0.0};
    glm::dvec3 e1{0.0};
    glm::dvec3 e2{0.0};
};

glm::dvec3 mirrored(const glm::dvec3& v, int chart) {
    return chart == 0 ? v : glm::dvec3(v.x, -v.y, v.z);
}

/// The frame of the smallest rotation from +Y, mirrored for the chart of the lower half.
CircleFrame frame_at(const glm::dvec3& g, int chart) {
    const glm::dvec3 up = mirrored(g, chart);
    const glm::dvec3 turn = up + glm::dvec3(0.0, 1.0, 0.0);
    const double scale = 1.0 / (1.0 + up.y);
    return {g, mirrored(glm::dvec3(1.0, 0.0, 0.0) - up.x * scale * turn, chart),
            mirrored(glm::dvec3(0.0, 0.0, 1.0) - up.z * scale * turn, chart)};
}

/// Inverse of the stereographic map p = (g_x, g_z)/(1 + g_y).
glm::dvec3 grating_vector(const glm::dvec2& p, int chart) {
    const double square = glm::dot(p, p);
    return mirrored(glm::dvec3(2.0 * p.x, 1.0 - square, 2.0 * p.y) / (1.0 + square), chart);
}

glm::dvec2 chart_point(const glm::dvec3& g, int chart) {
    const glm::dvec3 up = mirrored(g, chart);
    return glm::dvec2(up.x, up.z) / (1.0 + up.y);
}

/// Adds the moments of light around one g in cells of a. Per cell: kLanes terms of red, then green, then blue.
template <int kLanes>
void add_moments(const lighting::LightSamples& lights, const CircleFrame& frame, int cells, bool covered,
                 std::vector<float>& moments) {
    const glm::vec3 g(frame.g);
    const glm::vec3 e1(frame.e1);
    const glm::vec3 e2(frame.e2);
    const float scale = 0.5F * static_cast<float>(cells);
    const float last = static_cast<float>(cells - 1);
    std::array<float, kLanes> term{};
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float x = lights.x[i];
        const float y = lights.y[i];
        const float z = lights.z[i];
        const float cosine = x * e1.x + y * e1.y + z * e1.z;  // r cos t
        const float sine = x * e2.x + y * e2.y + z * e2.z;    // r sin t
        const float square = cosine * cosine + sine * sine;
        const float inverse = 1.0F / std::max(std::sqrt(square), 1e-6F);
        const float cos2 = (cosine * cosine - sine * sine) * inverse;  // r cos 2t
        const float sin2 = 2.0F * cosine * sine * inverse;
        const float cos4 = (cos2 * cos2 - sin2 * sin2) * inverse;
        const float sin4 = 2.0F * cos2 * sin2 * inverse;
        constexpr auto c = [](int k) { return 0.5F * static_cast<float>(kClampedCosine[static_cast<std::size_t>(k)]); };
        term[0] = c(0) * square * inverse;
        term[1] = c(1) * cosine;
        term[2] = c(1) * sine;
        term[3] = c(2) * cos2;
        term[4] = c(2) * sin2;
        term[5] = c(3) * cos4;
        term[6] = c(3) * sin4;
        if constexpr (kLanes > 8) {
            // cos 6t in air; cos 3t and cos 5t under a cover.
            const float cos_rest = covered ? cosine : cos4;
            const float sin_rest = covered ? sine : sin4;
            const float odd = covered ? 0.5F : c(4);
            term[7] = odd * (cos_rest * cos2 - sin_rest * sin2) * inverse;
            term[8] = odd * (cos_rest * sin2 + sin_rest * cos2) * inverse;
            term[9] = odd * (cosine * cos4 - sine * sin4) * inverse;
            term[10] = odd * (cosine * sin4 + sine * cos4) * inverse;
        }
        const float position = std::clamp((x * g.x + y * g.y + z * g.z + 1.0F) * scale - 0.5F, 0.0F, last);
        const int low = std::min(static_cast<int>(position), cells - 2);
        const float weight = position - static_cast<float>(low);
        float* to = moments.data() + static_cast<std::ptrdiff_t>(low) * 3 * kLanes;
        const std::array<float, 3> flux{lights.red[i], lights.green[i], lights.blue[i]};
        for (int half = 0; half < 2; ++half)
            for (int colour = 0; colour < 3; ++colour, to += kLanes) {
                const float light = flux[static_cast<std::size_t>(colour)] * (half == 0 ? 1.0F - weight : weight);
                for (std::size_t lane = 0; lane < kLanes; ++lane) to[lane] += light * term[lane];
            }
    }
}

template <int kLanes>
void fill_column(const lighting::LightSamples& lights, const KernelCells& kernel, const CoverFactors& cover, int chart,
                 int row, int column, CircleMap& map) {
    const glm::dvec2 at(column + 0.5, row + 0.5);
    glm::dvec2 p = (at / static_cast<double>(map.side) - 0.5) / map.scale();
    // No look-up reaches the corners.
    const double rim = 1.0 + 3.0 / (map.side * map.scale());
    if (glm::length(p) > rim) return;
    std::vector<float> moments(static_cast<std::size_t>(kernel.cells()) * 3 * kLanes, 0.0F);
    std::vector<float> xyz(static_cast<std::size_t>(map.views) * 3 * kLanes);
    add_moments<kLanes>(lights, frame_at(grating_vector(p, chart), chart), kernel.cells(), map.covered, moments);
    apply(cover, kLanes, moments);
    kernel.correlate<kLanes>(moments, xyz);
    for (int view = 0; view < map.views; ++view) {
        const float* from = xyz.data() + static_cast<std::ptrdiff_t>(view) * 3 * kLanes;
        for (int term = 0; term < map.terms; ++term)
            map.xyz[map.index(chart, term, view, row, column)] = {from[term], from[kLanes + term],
                                                                  from[2 * kLanes + term]};
    }
}

/// Optimises a slice's values for linear interpolation.
void sharpen_slice(CircleMap& map, int chart, int term, int view) {
    const auto side = static_cast<std::size_t>(map.side);
    glm::vec3* slice = map.xyz.data() + map.index(chart, term, view, 0, 0);
    const std::vector<glm::vec3> values(slice, slice + side * side);
    for (std::size_t row = 1; row + 1 < side; ++row)
        for (std::size_t column = 1; column + 1 < side; ++column) {
            const std::size_t i = row * side + column;
            slice[i] -=
                kBestLinear * (values[i - 1] + values[i + 1] + values[i - side] + values[i + side] - 4.0F * values[i]);
        }
}

glm::dvec3 term_at(const CircleMap& map, int chart, int term, const glm::dvec3& position) {
    glm::dvec3 sum(0.0);
    const auto low = [](double at, int count) { return std::clamp(static_cast<int>(std::floor(at)), 0, count - 2); };
    const int column = low(position.x, map.side);
    const int row = low(position.y, map.side);
    const int view = low(position.z, map.views);
    const glm::dvec3 t = glm::clamp(position - glm::dvec3(column, row, view), 0.0, 1.0);
    for (int corner = 0; corner < 8; ++corner) {
        const int i = corner & 1;
        const int j = (corner >> 1) & 1;
        const int k = corner >> 2;
        const double weight = (i == 1 ? t.x : 1 - t.x) * (j == 1 ? t.y : 1 - t.y) * (k == 1 ? t.z : 1 - t.z);
        sum += weight * glm::dvec3(map.xyz[map.index(chart, term, view + k, row + j, column + i)]);
    }
    return sum;
}

}  // namespace

std::size_t CircleMap::index(int chart, int term, int view, int row, int column) const {
    const auto u = [](int i) { return static_cast<std::size_t>(i); };
    return (((u(chart) * u(terms) + u(term)) * u(views) + u(view)) * u(side) + u(row)) * u(side) + u(column);
}

int circle_terms(const std::optional<Cover>& cover) {
    return cover ? 11 : 7;
}

std::array<double, 6> covered_cosine(double ior, double r) {
    constexpr int kNodes = 32;
    constexpr std::array<int, 6> kMultiples{0, 1, 2, 4, 3, 5};
    static const math::QuadratureRule rule = math::gauss_legendre(kNodes, 0.0, 0.5 * pi);
    std::array<double, 6> series{};
    for (std::size_t node = 0; node < rule.nodes.size(); ++node) {
        const double t = rule.nodes[node];
        const double value = rule.weights[node] * transmittance(ior, r * std::cos(t)) * std::cos(t);
        for (std::size_t k = 0; k < series.size(); ++k)
            series[k] += (k == 0 ? 1.0 : 2.0) / pi * value * std::cos(kMultiples[k] * t);
    }
    return series;
}

int look_ups_of(int terms) {
    return (3 * terms + 3) / 4;
}

int chart_count(const KernelTable& kernel) {
    return is_even(kernel) ? 1 : 2;
}

CircleMap fill_circle_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const CircleMapSize& size, const glm::dmat3& zero_order_xyz,
                          const std::optional<Cover>& cover, const std::stop_token& stop) {
    ROWLAND_CHECK_OP(size.side, >=, 8);
    ROWLAND_CHECK_OP(size.views, >=, 8);
    ROWLAND_CHECK(size.terms == 7 || size.terms == 9 || (cover && size.terms == 11),
                  "a circle map has 7 or 9 terms, under a cover 7, 9 or 11");
    CircleMap map{.charts = chart_count(kernel),
                  .terms = size.terms,
                  .covered = cover.has_value(),
                  .views = size.views,
                  .side = size.side,
                  .xyz = {}};
    map.xyz.resize(map.index(map.charts, 0, 0, 0, 0), glm::vec3(0.0F));
    const lighting::LightSamples lights = lighting::gather_texels(texels, kFaceSize);
    const KernelCells cells(kernel, pitch_nm, size.views, zero_order_xyz);
    const CoverFactors factors = cover_factors(cover, cells.cells());
    const auto side = static_cast<std::size_t>(size.side);
    parallel_for(static_cast<std::size_t>(map.charts) * side * side, [&](std::size_t i) {
        if (stop.stop_requested()) return;
        const int chart = static_cast<int>(i / (side * side));
        const int row = static_cast<int>(i / side % side);
        const int column = static_cast<int>(i % side);
        if (size.terms == 7)
            fill_column<8>(lights, cells, factors, chart, row, column, map);
        else
            fill_column<12>(lights, cells, factors, chart, row, column, map);
    });
    if (stop.stop_requested()) return map;
    const auto slices = static_cast<std::size_t>(map.terms) * static_cast<std::size_t>(map.views);
    parallel_for(static_cast<std::size_t>(map.charts) * slices, [&](std::size_t i) {
        const auto in_chart = static_cast<int>(i % slices);
        sharpen_slice(map, static_cast<int>(i / slices), in_chart / map.views, in_chart % map.views);
    });
    return map;
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
    const glm::dvec2 p = chart_point(at.g, chart) * map.scale() + 0.5;
    const glm::dvec3 position(p * static_cast<double>(map.side) - 0.5, 0.5 * (sign * v.x + 1.0) * (map.views - 1));
    const double c1 = glm::dot(to_world[2], at.e1);
    const double s1 = glm::dot(to_world[2], at.e2);
    const double c2 = c1 * c1 - s1 * s1;
    const double s2 = 2.0 * c1 * s1;
    const double c4 = c2 * c2 - s2 * s2;
    const double s4 = 2.0 * c2 * s2;
    const double c = map.covered ? c1 : c4;
    const double s = map.covered ? s1 : s4;
    const std::array<double, 11> f{
        1.0, c1, s1, c2, s2, c4, s4, c * c2 - s * s2, c * s2 + s * c2, c1 * c4 - s1 * s4, c1 * s4 + s1 * c4};
    glm::dvec3 sum(0.0);
    for (int term = 0; term < map.terms; ++term)
        sum += f[static_cast<std::size_t>(term)] * term_at(map, chart, term, position);
    return sum;
}

}  // namespace rowland::diffraction

// fill_circle_map(): moments of the light around each node's circles, correlated with the kernel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/representations/circle/circle_chart.h"
#include "modules/diffraction/representations/circle/circle_light.h"
#include "modules/diffraction/representations/circle/circle_map.h"

namespace rowland::diffraction {

namespace {

/// Nodes of a row that are correlated together: five terms of four nodes fill vector registers.
constexpr int kJoinedNodes = 4;

/// Cells of a cube's face that the light of the rest is divided among: its nodes are further apart. 40 would lose a
/// fifth of the accuracy under a probe with one small lamp.
constexpr int kRestLightCells = 56;

/// The multiples of the angle that a grid's moments have: `first`, first + step, …; of 0 the sine is left out.
struct Multiples {
    int first;
    int step;
    int terms;

    int of_term(int term) const { return first + (first == 0 ? (term + 1) / 2 : term / 2) * step; }
};
constexpr Multiples kOfTerms{.first = 0, .step = 1, .terms = kCircleTerms};
constexpr Multiples kOfRest{.first = 4, .step = 2, .terms = 10};
constexpr Multiples kOfCoveredRest{.first = 3, .step = 1, .terms = 12};  // where the series converges sooner
static_assert(kOfRest.first + (kOfRest.terms / 2 - 1) * kOfRest.step < kCircleMultiples);

/// The clamped cosine's coefficient for each cell of a and each term.
std::vector<float> coefficients(const std::optional<Cover>& cover, int cells, const Multiples& multiples) {
    std::vector<float> factors;
    for (int cell = 0; cell < cells; ++cell) {
        const double a = 2.0 * (cell + 0.5) / cells - 1.0;
        const auto series = clamped_cosine(cover, std::sqrt((1.0 - a) * (1.0 + a)));
        for (int term = 0; term < multiples.terms; ++term)
            factors.push_back(static_cast<float>(series[static_cast<std::size_t>(multiples.of_term(term))]));
    }
    return factors;
}

/// Functions of a grid from moments' terms: row j holds what function j takes of each term. The terms themselves, or
/// values at angles whose linear interpolation is best in the mean over the angle.
std::vector<float> functions_of_terms(const Multiples& multiples, int angles, double period) {
    std::vector<float> rows;
    const auto hat = [](double x) {
        const double half = std::numbers::pi * x;
        return half == 0.0 ? 1.0 : std::pow(std::sin(half) / half, 2);
    };
    for (int j = 0; j < angles; ++j)
        for (int term = 0; term < multiples.terms; ++term) {
            const int k = multiples.of_term(term);
            const double cycles = k * period / (2.0 * std::numbers::pi * angles);  // per step of the angle
            double power = 0.0;
            for (int alias = -8; alias <= 8; ++alias) power += std::pow(hat(cycles + alias), 2);
            const double t = k * period * j / angles;
            rows.push_back(static_cast<float>(hat(cycles) / power * (term % 2 == 0 ? std::cos(t) : std::sin(t))));
        }
    return rows;
}

/// (r cos, r sin) of multiples of the angle of a direction around g, where r² = 1 − a².
struct Angle {
    float cosine;
    float sine;

    /// Of the sum of two angles; `inverse` is 1/r.
    Angle plus(const Angle& other, float inverse) const {
        return {(cosine * other.cosine - sine * other.sine) * inverse,
                (cosine * other.sine + sine * other.cosine) * inverse};
    }
};

/// The weights of a direction's light in kMultiples' moments, without coefficients.
template <const Multiples& kMultiples>
std::array<float, kMultiples.terms> weights_at(const Angle& t) {
    const float square = t.cosine * t.cosine + t.sine * t.sine;
    const float inverse = 1.0F / std::max(std::sqrt(square), 1e-6F);
    const Angle t1{0.5F * t.cosine, 0.5F * t.sine};
    const Angle t2 = t1.plus(t, inverse);
    if constexpr (kMultiples.first == 0) {
        return {0.5F * square * inverse, t1.cosine, t1.sine, t2.cosine, t2.sine};
    } else {
        const Angle step = kMultiples.step == 1 ? t : t.plus(t, inverse);
        Angle now = t2.plus(step, inverse);
        std::array<float, kMultiples.terms> weights;
        for (std::size_t term = 0; term < weights.size(); term += 2) {
            weights[term] = now.cosine;
            weights[term + 1] = now.sine;
            now = now.plus(step, inverse);
        }
        return weights;
    }
}

/// Light from a direction: red, green, blue and 0, which are read as one vector.
struct Lamp {
    glm::vec3 direction;
    alignas(16) std::array<float, 4> flux;
};

std::vector<Lamp> lamps_of(const lighting::LightSamples& samples) {
    std::vector<Lamp> lamps(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        lamps[i] = {{samples.x[i], samples.y[i], samples.z[i]},
                    {samples.red[i], samples.green[i], samples.blue[i], 0.0F}};
    return lamps;
}

/// Adds the moments of light around one g in cells of a. Per cell: red, green, blue and 0 of each term.
template <const Multiples& kMultiples>
void add_moments(std::span<const Lamp> lamps, const CircleFrame& frame, int cells, std::vector<float>& moments) {
    constexpr std::size_t kTerms = kMultiples.terms;
    const glm::vec3 g(frame.g);
    const glm::vec3 e1(frame.e1);
    const glm::vec3 e2(frame.e2);
    const float scale = 0.5F * static_cast<float>(cells);
    const float last = static_cast<float>(cells - 1);
    for (const Lamp& lamp : lamps) {
        const glm::vec3& s = lamp.direction;
        const std::array<float, kTerms> weights =
            weights_at<kMultiples>({s.x * e1.x + s.y * e1.y + s.z * e1.z, s.x * e2.x + s.y * e2.y + s.z * e2.z});
        const float position = std::clamp((s.x * g.x + s.y * g.y + s.z * g.z + 1.0F) * scale - 0.5F, 0.0F, last);
        const int low = std::min(static_cast<int>(position), cells - 2);
        const float second = position - static_cast<float>(low);
        float* to = moments.data() + static_cast<std::size_t>(low) * 4 * kTerms;
        std::array<float, 4 * kTerms> light;
        for (std::size_t term = 0; term < kTerms; ++term)
            for (std::size_t c = 0; c < 4; ++c) light[4 * term + c] = weights[term] * lamp.flux[c];
        for (std::size_t k = 0; k < light.size(); ++k) to[k] += (1.0F - second) * light[k];
        to += light.size();
        for (std::size_t k = 0; k < light.size(); ++k) to[k] += second * light[k];
    }
}

/// Fills one grid of a map.
template <const Multiples& kMultiples>
class GridFilling {
 public:
    /// `functions`: functions_of_terms(), or empty for the terms.
    GridFilling(const lighting::LightSamples& texels, int light_cells, const KernelCells& kernel,
                const std::optional<Cover>& cover, std::vector<float> functions, CircleGrid& grid)
        : lamps_(lamps_of(circle_light(texels, light_cells))),
          light_variance_(circle_light_variance(light_cells)),
          kernel_(kernel),
          coefficients_(coefficients(cover, kernel.cells(), kMultiples)),
          functions_(std::move(functions)),
          grid_(grid) {}

    void fill(int charts, const std::stop_token& stop) {
        const auto rows = static_cast<std::size_t>(grid_.side);
        const std::size_t in_row = (rows + kJoinedNodes - 1) / kJoinedNodes;
        parallel_for(static_cast<std::size_t>(charts) * rows * in_row, [&](std::size_t i) {
            if (stop.stop_requested()) return;
            fill_nodes(static_cast<int>(i / (rows * in_row)), static_cast<int>(i / in_row % rows),
                       static_cast<int>(i % in_row) * kJoinedNodes);
        });
        if (stop.stop_requested()) return;
        const auto slices = static_cast<std::size_t>(grid_.functions * grid_.views);
        parallel_for(static_cast<std::size_t>(charts) * slices, [&](std::size_t i) { sharpen_slice(i); });
    }

 private:
    static constexpr int kTerms = kMultiples.terms;
    /// No look-up reaches the corners.
    bool is_read(const glm::dvec2& p) const { return glm::length(p) <= 1.0 + 3.0 / (grid_.side * grid_.scale()); }

    glm::dvec2 point_of(int row, int column) const {
        const glm::dvec2 at(column + 0.5, row + 0.5);
        return (at / static_cast<double>(grid_.side) - 0.5) / grid_.scale();
    }

    /// A node's moments, for each cell and colour beside those of the other nodes.
    void add_node(const glm::dvec2& p, int chart, std::size_t node, std::vector<float>& light) const {
        const auto cells = static_cast<std::size_t>(kernel_.cells());
        std::vector<float> moments(cells * 4 * kTerms, 0.0F);
        add_moments<kMultiples>(lamps_, frame_at(grating_vector(p, chart), chart), kernel_.cells(), moments);
        for (std::size_t i = 0; i < cells * kTerms; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                light[((i / kTerms * 3 + c) * kJoinedNodes + node) * kTerms + i % kTerms] =
                    coefficients_[i] * moments[i * 4 + c];
    }

    void fill_nodes(int chart, int row, int first) {
        constexpr int kLanes = kJoinedNodes * kTerms;
        const int count = std::min(kJoinedNodes, grid_.side - first);
        std::vector<float> light;
        for (int node = 0; node < count; ++node) {
            const glm::dvec2 p = point_of(row, first + node);
            if (!is_read(p)) continue;
            light.resize(static_cast<std::size_t>(kernel_.cells()) * 3 * kLanes, 0.0F);
            add_node(p, chart, static_cast<std::size_t>(node), light);
        }
        if (light.empty()) return;
        std::vector<float> xyz(static_cast<std::size_t>(grid_.views) * 3 * kLanes);
        kernel_.correlate<kLanes>(light, xyz);
        for (int view = 0; view < grid_.views; ++view)
            for (int node = 0; node < count; ++node) {
                const float* from = xyz.data() + static_cast<std::ptrdiff_t>(view) * 3 * kLanes +
                                    static_cast<std::ptrdiff_t>(node) * kTerms;
                for (int function = 0; function < grid_.functions; ++function)
                    grid_.xyz[grid_.index(chart, function, view, row, first + node)] = {
                        value(function, from), value(function, from + kLanes), value(function, from + 2 * kLanes)};
            }
    }

    float value(int function, const float* terms) const {
        if (functions_.empty()) return terms[function];
        const float* row = functions_.data() + static_cast<std::ptrdiff_t>(function) * kTerms;
        return std::inner_product(row, row + kTerms, terms, 0.0F);
    }

    /// By how much values are lowered, of their second difference: for linear interpolation, and for the light's blur.
    float sharpening_at(std::size_t row, std::size_t column) const {
        const glm::dvec2 p = point_of(static_cast<int>(row), static_cast<int>(column));
        const double step = 2.0 / (grid_.side * grid_.scale() * (1.0 + glm::dot(p, p)));  // of g
        return kBestLinear + static_cast<float>(0.5 * light_variance_ / (step * step));
    }

    /// Optimises the values of a chart's slice; slices in the order of the grid's values.
    void sharpen_slice(std::size_t number) {
        const auto side = static_cast<std::size_t>(grid_.side);
        glm::vec3* slice = grid_.xyz.data() + number * side * side;
        const std::vector<glm::vec3> values(slice, slice + side * side);
        for (std::size_t row = 1; row + 1 < side; ++row)
            for (std::size_t column = 1; column + 1 < side; ++column) {
                const std::size_t i = row * side + column;
                slice[i] -= sharpening_at(row, column) *
                            (values[i - 1] + values[i + 1] + values[i - side] + values[i + side] - 4.0F * values[i]);
            }
    }

    std::vector<Lamp> lamps_;
    double light_variance_;
    const KernelCells& kernel_;
    std::vector<float> coefficients_;
    std::vector<float> functions_;
    CircleGrid& grid_;
};

CircleGrid empty_grid(int charts, int functions, int views, int side) {
    CircleGrid grid{.functions = functions, .views = views, .side = side, .xyz = {}};
    grid.xyz.resize(grid.index(charts, 0, 0, 0, 0), glm::vec3(0.0F));
    return grid;
}

}  // namespace

CircleMap fill_circle_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const CircleMapSize& size, const glm::dmat3& zero_order_xyz,
                          const std::optional<Cover>& cover, const std::stop_token& stop) {
    ROWLAND_CHECK_OP(size.side, >=, 8);
    ROWLAND_CHECK_OP(size.views, >=, 8);
    ROWLAND_CHECK_OP(size.angles, >=, 0);
    const int charts = chart_count(kernel);
    const int angles = rest_angles(size.angles, cover.has_value());
    CircleMap map{.charts = charts,
                  .covered = cover.has_value(),
                  .terms = empty_grid(charts, kCircleTerms, size.views, size.side),
                  .rest = empty_grid(charts, angles, rest_views(size.views), rest_side(size.side))};
    const auto fill = [&]<const Multiples & kMultiples>(CircleGrid& grid, int light_cells, int functions) {
        const KernelCells cells(kernel, pitch_nm, grid.views, zero_order_xyz);
        GridFilling<kMultiples>(texels, light_cells, cells, cover,
                                functions_of_terms(kMultiples, functions, map.period()), grid)
            .fill(charts, stop);
    };
    fill.operator()<kOfTerms>(map.terms, kCircleLightCells, 0);
    if (angles == 0) return map;
    if (cover)
        fill.operator()<kOfCoveredRest>(map.rest, kRestLightCells, angles);
    else
        fill.operator()<kOfRest>(map.rest, kRestLightCells, angles);
    return map;
}

}  // namespace rowland::diffraction

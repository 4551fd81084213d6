// fill_circle_map(): moments of the light around each node's circles, correlated with the kernel.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <span>
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

/// Terms of one sort that circles have in air and under a cover: on 1, cos t, cos 2t, cos 4t.
constexpr std::size_t kInAir = 4;

/// For each cell of a, what a cover's coefficients are over those that moments have: in air, and 1 for cos 3t and 5t.
using CoverFactors = std::vector<std::array<float, 6>>;

CoverFactors cover_factors(const std::optional<Cover>& cover, int cells) {
    CoverFactors factors;
    for (int cell = 0; cover && cell < cells; ++cell) {
        const double a = 2.0 * (cell + 0.5) / cells - 1.0;
        const std::array<double, 6> series = covered_cosine(cover->ior, std::sqrt((1.0 - a) * (1.0 + a)));
        std::array<float, 6>& factor = factors.emplace_back();
        for (std::size_t k = 0; k < series.size(); ++k)
            factor[k] = static_cast<float>(k < kInAir ? series[k] / kClampedCosine[k] : series[k]);
    }
    return factors;
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

/// The weights of a direction's light in kTerms moments: those of level 0 or, with 2, 4 or 6 terms, of level 1.
template <int kTerms>
std::array<float, kTerms> weights_at(const Angle& t, bool covered) {
    constexpr auto c = [](std::size_t k) { return 0.5F * static_cast<float>(kClampedCosine[k]); };
    const float square = t.cosine * t.cosine + t.sine * t.sine;
    const float inverse = 1.0F / std::max(std::sqrt(square), 1e-6F);
    const Angle t2 = t.plus(t, inverse);
    if constexpr (kTerms == kFineTerms) {
        return {c(0) * square * inverse, c(1) * t.cosine, c(1) * t.sine, c(2) * t2.cosine, c(2) * t2.sine};
    } else {
        const Angle t4 = t2.plus(t2, inverse);
        std::array<float, kTerms> weights{c(3) * t4.cosine, c(3) * t4.sine};
        if constexpr (kTerms >= 4) {
            const Angle next = covered ? t.plus(t2, inverse) : t4.plus(t2, inverse);
            const float scale = covered ? 0.5F : c(4);
            weights[2] = scale * next.cosine;
            weights[3] = scale * next.sine;
        }
        if constexpr (kTerms >= 6) {
            const Angle t5 = t.plus(t4, inverse);
            weights[4] = 0.5F * t5.cosine;
            weights[5] = 0.5F * t5.sine;
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
template <int kTerms>
void add_moments(std::span<const Lamp> lamps, const CircleFrame& frame, int cells, bool covered,
                 std::vector<float>& moments) {
    const glm::vec3 g(frame.g);
    const glm::vec3 e1(frame.e1);
    const glm::vec3 e2(frame.e2);
    const float scale = 0.5F * static_cast<float>(cells);
    const float last = static_cast<float>(cells - 1);
    for (const Lamp& lamp : lamps) {
        const glm::vec3& s = lamp.direction;
        const std::array<float, kTerms> weights =
            weights_at<kTerms>({s.x * e1.x + s.y * e1.y + s.z * e1.z, s.x * e2.x + s.y * e2.y + s.z * e2.z}, covered);
        const float position = std::clamp((s.x * g.x + s.y * g.y + s.z * g.z + 1.0F) * scale - 0.5F, 0.0F, last);
        const int low = std::min(static_cast<int>(position), cells - 2);
        const float second = position - static_cast<float>(low);
        float* to = moments.data() + static_cast<std::ptrdiff_t>(low) * 4 * kTerms;
        std::array<float, 4 * kTerms> light;
        for (std::size_t term = 0; term < kTerms; ++term)
            for (std::size_t c = 0; c < 4; ++c) light[4 * term + c] = weights[term] * lamp.flux[c];
        for (std::size_t k = 0; k < light.size(); ++k) to[k] += (1.0F - second) * light[k];
        to += light.size();
        for (std::size_t k = 0; k < light.size(); ++k) to[k] += second * light[k];
    }
}

/// Fills one level of a map.
template <int kTerms>
class LevelFilling {
 public:
    LevelFilling(std::span<const Lamp> lamps, const KernelCells& kernel, const std::optional<Cover>& cover,
                 CircleLevel& level)
        : lamps_(lamps), kernel_(kernel), cover_(cover_factors(cover, kernel.cells())), level_(level) {}

    void fill(int charts, const std::stop_token& stop) {
        const auto rows = static_cast<std::size_t>(level_.side);
        const std::size_t in_row = (rows + kJoinedNodes - 1) / kJoinedNodes;
        parallel_for(static_cast<std::size_t>(charts) * rows * in_row, [&](std::size_t i) {
            if (stop.stop_requested()) return;
            fill_nodes(static_cast<int>(i / (rows * in_row)), static_cast<int>(i / in_row % rows),
                       static_cast<int>(i % in_row) * kJoinedNodes);
        });
        if (stop.stop_requested()) return;
        const auto slices = static_cast<std::size_t>(kTerms * level_.views);
        parallel_for(static_cast<std::size_t>(charts) * slices, [&](std::size_t i) { sharpen_slice(i); });
    }

 private:
    /// No look-up reaches the corners.
    bool is_read(const glm::dvec2& p) const { return glm::length(p) <= 1.0 + 3.0 / (level_.side * level_.scale()); }

    glm::dvec2 point_of(int row, int column) const {
        const glm::dvec2 at(column + 0.5, row + 0.5);
        return (at / static_cast<double>(level_.side) - 0.5) / level_.scale();
    }

    /// A node's moments, for each cell and colour beside those of the other nodes.
    void add_node(const glm::dvec2& p, int chart, std::size_t node, std::vector<float>& light) const {
        const auto cells = static_cast<std::size_t>(kernel_.cells());
        std::vector<float> moments(cells * 4 * kTerms, 0.0F);
        add_moments<kTerms>(lamps_, frame_at(grating_vector(p, chart), chart), kernel_.cells(), !cover_.empty(),
                            moments);
        for (std::size_t cell = 0; cell < cells; ++cell)
            for (std::size_t term = 0; term < kTerms; ++term) {
                const auto sort = (static_cast<std::size_t>(level_.first_term) + term + 1) / 2;
                const float factor = cover_.empty() ? 1.0F : cover_[cell][sort];
                for (std::size_t c = 0; c < 3; ++c)
                    light[((cell * 3 + c) * kJoinedNodes + node) * kTerms + term] =
                        factor * moments[(cell * kTerms + term) * 4 + c];
            }
    }

    void fill_nodes(int chart, int row, int first) {
        constexpr int kLanes = kJoinedNodes * kTerms;
        const int count = std::min(kJoinedNodes, level_.side - first);
        std::vector<float> light;
        for (int node = 0; node < count; ++node) {
            const glm::dvec2 p = point_of(row, first + node);
            if (!is_read(p)) continue;
            light.resize(static_cast<std::size_t>(kernel_.cells()) * 3 * kLanes, 0.0F);
            add_node(p, chart, static_cast<std::size_t>(node), light);
        }
        if (light.empty()) return;
        std::vector<float> xyz(static_cast<std::size_t>(level_.views) * 3 * kLanes);
        kernel_.correlate<kLanes>(light, xyz);
        for (int view = 0; view < level_.views; ++view)
            for (int node = 0; node < count; ++node)
                for (int term = 0; term < kTerms; ++term) {
                    const float* from = xyz.data() + static_cast<std::ptrdiff_t>(view) * 3 * kLanes +
                                        static_cast<std::ptrdiff_t>(node) * kTerms + term;
                    level_.xyz[level_.index(chart, term, view, row, first + node)] = {from[0], from[kLanes],
                                                                                      from[2 * kLanes]};
                }
    }

    /// By how much values are lowered, of their second difference: for linear interpolation, and for the light's blur.
    float sharpening_at(std::size_t row, std::size_t column) const {
        const glm::dvec2 p = point_of(static_cast<int>(row), static_cast<int>(column));
        const double step = 2.0 / (level_.side * level_.scale() * (1.0 + glm::dot(p, p)));  // of g
        return kBestLinear + static_cast<float>(0.5 * kCircleLightVariance / (step * step));
    }

    /// Optimises the values of a chart's slice; slices in the order of a level's values.
    void sharpen_slice(std::size_t number) {
        const auto side = static_cast<std::size_t>(level_.side);
        glm::vec3* slice = level_.xyz.data() + number * side * side;
        const std::vector<glm::vec3> values(slice, slice + side * side);
        for (std::size_t row = 1; row + 1 < side; ++row)
            for (std::size_t column = 1; column + 1 < side; ++column) {
                const std::size_t i = row * side + column;
                slice[i] -= sharpening_at(row, column) *
                            (values[i - 1] + values[i + 1] + values[i - side] + values[i + side] - 4.0F * values[i]);
            }
    }

    std::span<const Lamp> lamps_;
    const KernelCells& kernel_;
    CoverFactors cover_;
    CircleLevel& level_;
};

CircleMap empty_map(int charts, const CircleMapSize& size, bool covered) {
    CircleMap map{.charts = charts,
                  .covered = covered,
                  .levels = {{{.first_term = 0, .terms = kFineTerms, .views = size.views, .side = size.side, .xyz = {}},
                              {.first_term = kFineTerms,
                               .terms = size.terms - kFineTerms,
                               .views = size.views / 2,
                               .side = size.side / 2,
                               .xyz = {}}}}};
    for (CircleLevel& level : map.levels) level.xyz.resize(level.index(charts, 0, 0, 0, 0), glm::vec3(0.0F));
    return map;
}

}  // namespace

CircleMap fill_circle_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const CircleMapSize& size, const glm::dmat3& zero_order_xyz,
                          const std::optional<Cover>& cover, const std::stop_token& stop) {
    ROWLAND_CHECK(size.side >= 8 && size.side % 2 == 0, "a circle map's side is even and at least 8");
    ROWLAND_CHECK(size.views >= 8 && size.views % 2 == 0, "a circle map's number of views is even and at least 8");
    ROWLAND_CHECK(size.terms % 2 == 1 && size.terms >= kFineTerms && size.terms <= (cover ? 11 : 9),
                  "a circle map has 5, 7 or 9 terms, under a cover 11 as well");
    CircleMap map = empty_map(chart_count(kernel), size, cover.has_value());
    const std::vector<Lamp> lamps = lamps_of(circle_light(texels));
    const auto fill = [&]<int kTerms>(CircleLevel& level) {
        const KernelCells cells(kernel, pitch_nm, level.views, zero_order_xyz);
        LevelFilling<kTerms>(lamps, cells, cover, level).fill(map.charts, stop);
    };
    fill.operator()<kFineTerms>(map.levels[0]);
    if (map.levels[1].terms == 2) fill.operator()<2>(map.levels[1]);
    if (map.levels[1].terms == 4) fill.operator()<4>(map.levels[1]);
    if (map.levels[1].terms == 6) fill.operator()<6>(map.levels[1]);
    return map;
}

}  // namespace rowland::diffraction

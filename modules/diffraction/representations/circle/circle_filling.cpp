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
#include "modules/diffraction/representations/circle/circle.h"
#include "modules/diffraction/representations/circle/circle_map.h"

namespace rowland::diffraction {

namespace {

/// Cells along a side of a cube's face for the light of the remainder: fewer than kCircleLightCells, as the remainder's
/// nodes are farther apart. 40 would lose a fifth of the accuracy under a probe with one small lamp.
constexpr int kRemainderLightCells = 56;

/// The multiples of the angle that a grid's moments have: `first`, first + step, …; 0 has no sine.
struct Multiples {
    int first;
    int step;
    int terms;

    int of_term(int term) const { return first + (first == 0 ? (term + 1) / 2 : term / 2) * step; }
};
constexpr Multiples kOfTerms{.first = 0, .step = 1, .terms = kCircleTerms};
constexpr Multiples kOfRemainder{.first = 4, .step = 2, .terms = 10};
constexpr Multiples kOfCoveredRemainder{.first = 3, .step = 1, .terms = 12};  // its series converges sooner
static_assert(kOfRemainder.first + (kOfRemainder.terms / 2 - 1) * kOfRemainder.step < kCircleMultiples);

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

/// The identity, in the layout of functions_of_terms().
std::vector<float> unchanged_terms() {
    std::vector<float> rows(std::size_t{kCircleTerms} * kCircleTerms, 0.0F);
    for (std::size_t term = 0; term < kCircleTerms; ++term) rows[term * (kCircleTerms + 1)] = 1.0F;
    return rows;
}

/// The remainder's functions from its terms: row j holds function j's coefficients of the terms. Linear interpolation
/// between the functions fits the series in the least-squares sense. The matrix is tridiagonal and cyclic; three
/// Gauss–Seidel sweeps give a digit.
std::vector<float> functions_of_terms(const Multiples& multiples, int angles, double period) {
    constexpr int kStepsPerAngle = 64;
    constexpr int kSweeps = 40;
    const auto n = static_cast<std::size_t>(angles);
    const auto terms = static_cast<std::size_t>(multiples.terms);
    std::vector<double> here(n, 0.0);  // inner products of each hat function with itself
    std::vector<double> next(n, 0.0);  // and with the next
    std::vector<double> right(n * terms, 0.0);
    for (int i = 0; i < angles * kStepsPerAngle; ++i) {
        const double turn = (i + 0.5) / (angles * kStepsPerAngle);
        const double position =
            circle_turn(std::cos(2.0 * std::numbers::pi * turn), std::sin(2.0 * std::numbers::pi * turn)) * angles;
        const auto low = static_cast<std::size_t>(std::floor(position) + angles) % n;
        const double second = position - std::floor(position);
        here[low] += (1.0 - second) * (1.0 - second);
        here[(low + 1) % n] += second * second;
        next[low] += second * (1.0 - second);
        for (std::size_t term = 0; term < terms; ++term) {
            const double t = multiples.of_term(static_cast<int>(term)) * period * turn;
            const double value = term % 2 == 0 ? std::cos(t) : std::sin(t);
            right[low * terms + term] += (1.0 - second) * value;
            right[(low + 1) % n * terms + term] += second * value;
        }
    }
    std::vector<double> rows(n * terms, 0.0);
    for (int sweep = 0; sweep < kSweeps; ++sweep)
        for (std::size_t j = 0; j < n; ++j)
            for (std::size_t term = 0; term < terms; ++term) {
                const double before = next[(j + n - 1) % n] * rows[(j + n - 1) % n * terms + term];
                const double after = next[j] * rows[(j + 1) % n * terms + term];
                rows[j * terms + term] = (right[j * terms + term] - before - after) / here[j];
            }
    return {rows.begin(), rows.end()};
}

/// (r cos, r sin) of multiples of the angle of a direction around g, where r² = 1 − a².
struct Angle {
    float cosine;
    float sine;

    /// The value at the sum of two angles; `inverse` is 1/r.
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

/// Adds the moments of light around one g, and around its images, in cells of a. Per cell, colour and term: two
/// vectors of four images each.
template <const Multiples& kMultiples>
void add_moments(std::span<const ImageLight> light, const CircleFrame& frame, int cells, std::vector<Four>& moments) {
    constexpr std::size_t kColour = std::size_t{2} * kMultiples.terms;
    const glm::vec3 g(frame.g);
    const glm::vec3 e1(frame.e1);
    const glm::vec3 e2(frame.e2);
    const float scale = 0.5F * static_cast<float>(cells);
    const float last = static_cast<float>(cells - 1);
    for (const ImageLight& from : light) {
        const glm::vec3 s = from.direction;
        const auto weights = weights_at<kMultiples>({glm::dot(s, e1), glm::dot(s, e2)});
        const float position = std::clamp((glm::dot(s, g) + 1.0F) * scale - 0.5F, 0.0F, last);
        const int low = std::min(static_cast<int>(position), cells - 2);
        const float second = position - static_cast<float>(low);
        Four* const cell = moments.data() + static_cast<std::size_t>(low) * 3 * kColour;
        const std::array<Four, 6> flux = from.flux;  // in registers
        for (std::size_t term = 0; term < weights.size(); ++term) {
            const float far = second * weights[term];
            const float near = weights[term] - far;
            for (std::size_t i = 0; i < flux.size(); ++i) {
                Four* const to = cell + i / 2 * kColour + 2 * term + i % 2;
                to[0] += near * flux[i];
                to[3 * kColour] += far * flux[i];
            }
        }
    }
}

/// The rows of `functions` for an image's node, in terms of image 0's moments: the angles differ by angle_image().
std::vector<float> functions_of_image(const Multiples& multiples, const std::vector<float>& functions,
                                      std::size_t image) {
    const AngleImage angle = angle_image(image);
    std::vector<float> rows = functions;
    const auto terms = static_cast<std::size_t>(multiples.terms);
    for (std::size_t row = 0; row < rows.size(); row += terms)
        for (std::size_t term = multiples.first == 0 ? 1 : 0; term < terms; term += 2) {
            const double turn = 0.5 * std::numbers::pi * angle.quarters * multiples.of_term(static_cast<int>(term));
            const auto c = static_cast<float>(std::round(std::cos(turn)));
            const auto s = static_cast<float>(std::round(std::sin(turn)));
            const float of_cosine = functions[row + term];
            const float of_sine = functions[row + term + 1];
            rows[row + term] = c * of_cosine + s * of_sine;
            rows[row + term + 1] = static_cast<float>(angle.sign) * (c * of_sine - s * of_cosine);
        }
    return rows;
}

/// Fills one grid of a map.
template <const Multiples& kMultiples>
class GridFilling {
 public:
    /// `functions`: of the terms, a row for each of the grid's functions.
    GridFilling(const lighting::LightSamples& texels, int light_cells, const KernelCells& kernel,
                const std::optional<Cover>& cover, const std::vector<float>& functions, CircleGrid& grid)
        : light_(circle_light(texels, light_cells)),
          light_variance_(circle_light_variance(light_cells)),
          kernel_(kernel),
          coefficients_(coefficients(cover, kernel.cells(), kMultiples)),
          grid_(grid) {
        for (std::size_t image = 0; image < kCircleImages; ++image)
            functions_[image] = functions_of_image(kMultiples, functions, image);
    }

    void fill(int charts, const std::stop_token& stop) {
        const std::vector<glm::ivec2> nodes = first_nodes();
        parallel_for(nodes.size(), [&](std::size_t i) {
            if (!stop.stop_requested()) fill_images(nodes[i], charts);
        });
        if (stop.stop_requested()) return;
        const auto slices = static_cast<std::size_t>(grid_.functions * grid_.views);
        parallel_for(static_cast<std::size_t>(charts) * slices, [&](std::size_t i) { sharpen_slice(i); });
    }

 private:
    static constexpr std::size_t kTerms = kMultiples.terms;
    static constexpr std::size_t kFours = kTerms * kCircleImages / 4;

    /// Whether look-ups reach a point: none reaches the corners.
    bool is_read(const glm::dvec2& p) const { return glm::length(p) <= 1.0 + 3.0 / (grid_.side * grid_.scale()); }

    glm::dvec2 point_of(const glm::ivec2& node) const {
        return ((glm::dvec2(node) + 0.5) / static_cast<double>(grid_.side) - 0.5) / grid_.scale();
    }

    /// Column and row of nodes that, with their images, are all nodes of a chart.
    std::vector<glm::ivec2> first_nodes() const {
        std::vector<glm::ivec2> nodes;
        for (int row = grid_.side / 2; row < grid_.side; ++row)
            for (int column = row; column < grid_.side; ++column)
                if (is_read(point_of({column, row}))) nodes.emplace_back(column, row);
        return nodes;
    }

    void fill_images(const glm::ivec2& node, int charts) {
        const int cells = kernel_.cells();
        std::vector<Four> light(static_cast<std::size_t>(cells) * 3 * kFours, Four{});
        add_moments<kMultiples>(light_, frame_at(grating_vector(point_of(node), 0), 0), cells, light);
        for (std::size_t i = 0; i < light.size(); ++i)
            light[i] *= coefficients_[i / (3 * kFours) * kTerms + i % kFours / 2];
        std::vector<Four> xyz(static_cast<std::size_t>(grid_.views) * 3 * kFours);
        kernel_.correlate<kFours>(light, xyz);
        set_images(node, 0, xyz);
        if (charts == 1) return;
        // g of chart 1 at p is −g of chart 0 at −p, with the same angles: its cells of a are those in reverse.
        for (auto [low, high] = std::pair(light.begin(), light.end()); low < high - 3 * kFours; low += 3 * kFours) {
            high -= 3 * kFours;
            std::swap_ranges(low, low + 3 * kFours, high);
        }
        kernel_.correlate<kFours>(light, xyz);
        set_images(node, 1, xyz);
    }

    /// Sets a chart's nodes from a node's terms and those of its images: XYZ for each view.
    void set_images(const glm::ivec2& node, int chart, const std::vector<Four>& xyz) {
        for (std::size_t image = 0; image < kCircleImages; ++image) {
            // In half steps from the middle, where the images are symmetric.
            glm::ivec3 at(2 * node.x + 1 - grid_.side, 0, 2 * node.y + 1 - grid_.side);
            at = (circle_image(at, image) * (chart == 0 ? 1 : -1) + grid_.side - 1) / 2;
            for (int view = 0; view < grid_.views; ++view) {
                const Four* from = xyz.data() + static_cast<std::size_t>(view) * 3 * kFours + image / 4;
                for (int function = 0; function < grid_.functions; ++function) {
                    const float* row = functions_[image].data() + static_cast<std::size_t>(function) * kTerms;
                    glm::vec3& value = grid_.xyz[grid_.index(chart, function, view, at.z, at.x)];
                    value = glm::vec3(0.0F);
                    for (std::size_t term = 0; term < kTerms; ++term)
                        for (int c = 0; c < 3; ++c)
                            value[c] += row[term] * from[static_cast<std::size_t>(c) * kFours + 2 * term][image % 4];
                }
            }
        }
    }

    /// The fraction of their second difference by which values are lowered: for linear interpolation, and for the
    /// light's blur.
    float sharpening_at(int row, int column) const {
        const glm::dvec2 p = point_of({column, row});
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
                slice[i] -= sharpening_at(static_cast<int>(row), static_cast<int>(column)) *
                            (values[i - 1] + values[i + 1] + values[i - side] + values[i + side] - 4.0F * values[i]);
            }
    }

    std::vector<ImageLight> light_;
    double light_variance_;
    const KernelCells& kernel_;
    std::vector<float> coefficients_;
    std::array<std::vector<float>, kCircleImages> functions_;  ///< by image
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
                  .remainder = empty_grid(charts, angles, remainder_views(size.views), remainder_side(size.side))};
    const auto fill = [&]<const Multiples & kMultiples>(CircleGrid& grid, int light_cells,
                                                        const std::vector<float>& functions) {
        const KernelCells cells(kernel, pitch_nm, grid.views, zero_order_xyz);
        GridFilling<kMultiples>(texels, light_cells, cells, cover, functions, grid).fill(charts, stop);
    };
    fill.operator()<kOfTerms>(map.terms, kCircleLightCells, unchanged_terms());
    if (angles == 0) return map;
    const Multiples& of_rest = cover ? kOfCoveredRemainder : kOfRemainder;
    const std::vector<float> functions = functions_of_terms(of_rest, angles, map.period());
    if (cover)
        fill.operator()<kOfCoveredRemainder>(map.remainder, kRemainderLightCells, functions);
    else
        fill.operator()<kOfRemainder>(map.remainder, kRemainderLightCells, functions);
    return map;
}

}  // namespace rowland::diffraction

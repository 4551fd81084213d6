#include "modules/diffraction/representations/planar/lobe_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/math/fourier_transform.h"
#include "modules/diffraction/bake/kernel_cells.h"

namespace rowland::diffraction {

namespace {

using math::FourierTransform;
constexpr std::size_t kLightLanes = FourierTransform::kLanes;

/// Half the variance, in squares of a step, by which the distributions blur a map along an axis: the light's and the
/// pattern's among two nodes (1/6 each) and the disc's, of cells of half a step (1/24).
constexpr float kBlur = 3.0F / 16.0F;
/// The same of refined()'s quadratic spline.
constexpr float kSplineBlur = 1.0F / 8.0F;
/// Steps of sharpening along an axis of views: more restore finer detail.
constexpr int kSteps = 4;
/// In a step, a node that is darker than its neighbours gives at most this fraction of its light to one of them. Twice
/// as much amplifies ripples of the light until they show as stripes.
constexpr float kMayDarken = 0.05F;

/// Factors of the frequencies of one axis that blur the light's samples to the bilinear radiance between them: a
/// texel's hat function, whose variance is a sixth of its squared side, as a random walk between neighbouring nodes.
std::vector<float> between_samples(std::size_t samples, std::size_t size, double step) {
    const double variance = 4.0 * std::numbers::pi / (6.0 * static_cast<double>(std::max<std::size_t>(samples, 1)));
    std::vector<float> factors;
    for (std::size_t f = 0; f < size; ++f) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(f) / static_cast<double>(size);
        factors.push_back(static_cast<float>(std::exp(-variance / (step * step) * (1.0 - std::cos(angle)))));
    }
    return factors;
}

/// A grid of complex numbers in which two azimuths are computed at once: as the pattern is real, the real parts belong
/// to the first azimuth and the imaginary parts to the second. Rows along h, one for each node along g.
class AzimuthPair {
 public:
    /// `samples`: of the light, over the sphere.
    AzimuthPair(const LobeSpectrum& spectrum, std::size_t samples);

    /// Adds the light of the disc, turned so that g is the first axis. `part` 0: the pair's first azimuth.
    void add_light(const LightDisc& disc, double azimuth, int part);
    void correlate();
    /// XYZ of one of the azimuths at a view.
    glm::vec3 value(int part, int view_g, int view_h) const;

 private:
    using Parts = FourierTransform::Parts;
    Parts row(int view_g);
    void transform_columns();

    const LobeSpectrum& spectrum_;
    FourierTransform along_g_;
    FourierTransform along_h_;
    std::vector<float> between_g_;
    std::vector<float> between_h_;
    std::size_t row_stride_;  ///< in floats; not a power of two, so that a column's floats are not in one cache set
    std::array<std::vector<float>, 2> parts_;   ///< real and imaginary: views.g rows
    std::array<std::vector<float>, 2> column_;  ///< a column, and room for a transform's work
    std::array<std::vector<float>, 2> light_;   ///< a column of the light alone, for patterns of several terms
    std::array<std::vector<float>, 2> work_;
};

AzimuthPair::AzimuthPair(const LobeSpectrum& spectrum, std::size_t samples)
    : spectrum_(spectrum),
      along_g_(spectrum.size_g()),
      along_h_(spectrum.size_h()),
      between_g_(between_samples(samples, spectrum.size_g(), spectrum.views().step_g())),
      between_h_(between_samples(samples, spectrum.size_h(), spectrum.views().step_h())),
      row_stride_(kLightLanes * (spectrum.size_h() + 4)) {
    const std::size_t longest = kLightLanes * std::max(spectrum.size_g(), spectrum.size_h());
    for (auto& part : parts_) part.assign(static_cast<std::size_t>(spectrum.views().g) * row_stride_, 0.0F);
    for (auto& part : column_) part.assign(kLightLanes * spectrum.size_g(), 0.0F);
    for (auto& part : work_) part.assign(longest, 0.0F);
}

void AzimuthPair::add_light(const LightDisc& disc, double azimuth, int part) {
    const LobeMapViews& views = spectrum_.views();
    const int size_h = static_cast<int>(spectrum_.size_h());
    // Positions in steps of the grid: linear in the disc's column and row.
    const auto in_steps = [](double value, int nodes) { return static_cast<float>(0.5 * value * (nodes - 1)); };
    const double cell = 2.0 / disc.cells;
    const float column_g = in_steps(cell * std::cos(azimuth), views.g);
    const float row_g = in_steps(cell * std::sin(azimuth), views.g);
    const float column_h = in_steps(-cell * std::sin(azimuth), views.h);
    const float row_h = in_steps(cell * std::cos(azimuth), views.h);
    const float middle = 0.5F * static_cast<float>(disc.cells - 1);
    const float middle_g = 0.5F * static_cast<float>(views.g - 1);
    const float middle_h = 0.5F * static_cast<float>(views.h - 1);
    const float last_g = 2.0F * middle_g - 1e-3F;
    const float last_h = 2.0F * middle_h - 1e-3F;
    float* const grid = parts_[static_cast<std::size_t>(part)].data();
    for (int row = 0; row < disc.cells; ++row) {
        const float y = static_cast<float>(row) - middle;
        const auto [begin, end] = lit_columns(disc.cells, row);
        const float* light =
            disc.fluxes.data() + (static_cast<std::ptrdiff_t>(row) * disc.cells + begin) * std::ptrdiff_t{kLightLanes};
        for (int column = begin; column < end; ++column, light += kLightLanes) {
            const float x = static_cast<float>(column) - middle;
            const float at_g = std::clamp(middle_g + column_g * x + row_g * y, 0.0F, last_g);
            const float at_h = std::clamp(middle_h + column_h * x + row_h * y, 0.0F, last_h);
            const int low_g = static_cast<int>(at_g);
            const int low_h = static_cast<int>(at_h);
            const float part_g = at_g - static_cast<float>(low_g);
            const float part_h = at_h - static_cast<float>(low_h);
            // Node 0 of u is v = −s: the light's last node along h comes first.
            const int first_h = low_h - (views.h - 1) + size_h;
            for (int i = 0; i < 2; ++i) {
                float* to = grid + static_cast<std::size_t>(low_g + i) * row_stride_;
                for (int j = 0; j < 2; ++j) {
                    const float weight = (i == 0 ? 1.0F - part_g : part_g) * (j == 0 ? 1.0F - part_h : part_h);
                    const int node = first_h + j < size_h ? first_h + j : first_h + j - size_h;
                    float* lanes = to + static_cast<std::size_t>(node) * kLightLanes;
                    for (std::size_t c = 0; c < kLightLanes; ++c) lanes[c] += weight * light[c];
                }
            }
        }
    }
}

AzimuthPair::Parts AzimuthPair::row(int view_g) {
    const std::size_t begin = static_cast<std::size_t>(view_g) * row_stride_;
    const std::size_t count = kLightLanes * along_h_.size();
    return {std::span(parts_[0]).subspan(begin, count), std::span(parts_[1]).subspan(begin, count)};
}

/// Multiplies a frequency's light (r, g, b) by the pattern's matrix and a number.
void multiply(const float* matrix, float factor, float* real, float* imaginary) {
    std::array<float, kLightLanes> product_r{};
    std::array<float, kLightLanes> product_i{};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t o = 0; o < kLightLanes; ++o) {
            const float r = factor * matrix[kLightLanes * c + o];
            const float i = factor * matrix[kLightLanes * (3 + c) + o];
            product_r[o] += r * real[c] - i * imaginary[c];
            product_i[o] += r * imaginary[c] + i * real[c];
        }
    std::copy(product_r.begin(), product_r.end(), real);
    std::copy(product_i.begin(), product_i.end(), imaginary);
}

void AzimuthPair::transform_columns() {
    const int views = spectrum_.views().g;
    const int size = static_cast<int>(along_g_.size());
    const auto work = [&] {
        const std::size_t count = kLightLanes * along_g_.size();
        return Parts{std::span(work_[0]).first(count), std::span(work_[1]).first(count)};
    };
    for (std::size_t h = 0; h < along_h_.size(); ++h) {
        for (std::size_t part = 0; part < 2; ++part) {
            float* to = column_[part].data();
            std::fill_n(to, column_[part].size(), 0.0F);
            const float* from = parts_[part].data() + kLightLanes * h;
            for (int i = 0; i < views; ++i) {
                const int node = (i - (views - 1) + size) % size;
                std::copy_n(from + static_cast<std::size_t>(i) * row_stride_, kLightLanes,
                            to + kLightLanes * static_cast<std::size_t>(node));
            }
        }
        along_g_({column_[0], column_[1]}, work());
        const std::size_t terms = spectrum_.terms();
        if (terms > 1) light_ = column_;
        for (std::size_t term = 0; term < terms; ++term) {
            if (term > 0) column_ = light_;
            const float* matrix = spectrum_.at(h, term).data();
            for (std::size_t g = 0; g < along_g_.size(); ++g, matrix += LobeSpectrum::kFloats)
                multiply(matrix, between_g_[g] * between_h_[h], column_[0].data() + kLightLanes * g,
                         column_[1].data() + kLightLanes * g);
            along_g_({column_[0], column_[1]}, work());
            for (int i = 0; i < views; ++i) {
                const float factor = spectrum_.factor_at(term, i);
                for (std::size_t part = 0; part < 2; ++part) {
                    const float* const from = column_[part].data() + kLightLanes * static_cast<std::size_t>(i);
                    float* const to = parts_[part].data() + static_cast<std::size_t>(i) * row_stride_ + kLightLanes * h;
                    for (std::size_t lane = 0; lane < kLightLanes; ++lane)
                        to[lane] = (term == 0 ? 0.0F : to[lane]) + factor * from[lane];
                }
            }
        }
    }
}

void AzimuthPair::correlate() {
    const auto transform_row = [&](int i) {
        const std::size_t count = kLightLanes * along_h_.size();
        along_h_(row(i), {std::span(work_[0]).first(count), std::span(work_[1]).first(count)});
    };
    for (int i = 0; i < spectrum_.views().g; ++i) transform_row(i);
    transform_columns();
    for (int i = 0; i < spectrum_.views().g; ++i) transform_row(i);
}

glm::vec3 AzimuthPair::value(int part, int view_g, int view_h) const {
    const float* at = parts_[static_cast<std::size_t>(part)].data() + static_cast<std::size_t>(view_g) * row_stride_ +
                      kLightLanes * static_cast<std::size_t>(view_h);
    return {at[0], at[1], at[2]};
}

/// The light that moves from `low` to `high`: `fraction` of their difference. The darker one keeps as much as its own
/// darker neighbour has, or nearly. `before`, `after`: the differences on both sides.
glm::vec3 light_moved(float fraction, const glm::vec3& low, const glm::vec3& high, const glm::vec3& before,
                      const glm::vec3& after) {
    const glm::vec3 none(0.0F);
    const glm::vec3 up = glm::max(before, none);
    const glm::vec3 down = glm::max(-after, none);
    const glm::vec3 moved = fraction * (high - low);
    return glm::max(glm::min(moved, up + kMayDarken * glm::abs(low - up)),
                    glm::min(glm::max(moved, -down - kMayDarken * glm::abs(high - down)), none));
}

/// The middle one of five neighbours, sharpened by `fraction` of the second difference. Light only moves between
/// neighbours, so that the mean stays, and no node gets darker than black: around lamps there are no rings.
glm::vec3 sharpened(float fraction, const std::array<glm::vec3, 5>& x) {
    const glm::vec3 below = x[2] - x[1];
    const glm::vec3 above = x[3] - x[2];
    return x[2] + light_moved(fraction, x[1], x[2], x[1] - x[0], above) -
           light_moved(fraction, x[2], x[3], below, x[4] - x[3]);
}

/// Sharpens a line of nodes, which continues linearly beyond its ends.
void sharpen_line(float fraction, glm::vec3* values, std::size_t count, std::size_t stride,
                  std::vector<glm::vec3>& work) {
    work.resize(count + 4);
    for (std::size_t i = 0; i < count; ++i) work[i + 2] = values[i * stride];
    for (std::size_t i = 2; i > 0; --i) {
        work[i - 1] = 2.0F * work[i] - work[i + 1];
        work[count + 4 - i] = 2.0F * work[count + 3 - i] - work[count + 2 - i];
    }
    for (std::size_t i = 0; i < count; ++i)
        values[i * stride] = sharpened(fraction, {work[i], work[i + 1], work[i + 2], work[i + 3], work[i + 4]});
}

/// Undoes the blur along both axes of views, and that of the interpolation between the nodes before it happens.
/// `interpolation`: half its variance in squares of a step, or kBestLinear.
void sharpen_slice(glm::vec3* values, const LobeMapViews& views, float interpolation) {
    const float fraction = (kBlur + interpolation) / kSteps;
    const auto g = static_cast<std::size_t>(views.g);
    const auto h = static_cast<std::size_t>(views.h);
    std::vector<glm::vec3> work;
    for (int step = 0; step < kSteps; ++step) {
        for (std::size_t i = 0; i < h; ++i) sharpen_line(fraction, values + i * g, g, 1, work);
        for (std::size_t i = 0; i < g; ++i) sharpen_line(fraction, values + i, h, g, work);
    }
}

void copy_slice(const AzimuthPair& pair, int part, const LobeMapViews& views, float interpolation, glm::vec3* to) {
    glm::vec3* next = to;
    for (int h = 0; h < views.h; ++h)
        for (int g = 0; g < views.g; ++g) *next++ = pair.value(part, g, h);
    sharpen_slice(to, views, interpolation);
}

/// The quadratic spline of coefficients along a line, at the nodes and in the middles between them. Beyond its ends, a
/// line continues with the last coefficient.
void refine_line(const glm::vec3* from, std::size_t count, glm::vec3* to, std::size_t stride) {
    const auto at = [&](std::size_t i) { return from[std::min(i, count - 1) * stride]; };
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 before = at(i > 0 ? i - 1 : 0);
        to[2 * i * stride] = 0.125F * before + 0.75F * at(i) + 0.125F * at(i + 1);
        if (i + 1 < count) to[(2 * i + 1) * stride] = 0.5F * (at(i) + at(i + 1));
    }
}

/// The quadratic spline of a slice's coefficients on a grid of half the step. Without it a lamp's streak across the
/// grid's axes shows as a staircase: what linear interpolation adds around a bright node ends in straight lines.
std::vector<glm::vec3> refined(std::span<const glm::vec3> coefficients, const LobeMapViews& coarse,
                               const LobeMapViews& fine) {
    const auto rows = static_cast<std::size_t>(coarse.h);
    const auto columns = static_cast<std::size_t>(fine.g);
    const auto from_columns = static_cast<std::size_t>(coarse.g);
    std::vector<glm::vec3> wide(columns * rows);
    for (std::size_t row = 0; row < rows; ++row)
        refine_line(coefficients.data() + row * from_columns, from_columns, wide.data() + row * columns, 1);
    std::vector<glm::vec3> result(columns * static_cast<std::size_t>(fine.h));
    for (std::size_t column = 0; column < columns; ++column)
        refine_line(wide.data() + column, rows, result.data() + column, columns);
    return result;
}

/// The radiance of a map's azimuths, slice by slice.
class LobeSlices {
 public:
    LobeSlices(const lighting::LightSamples& texels, const LobeSpectrum& spectrum, const PlaneAxes& axes, int azimuths)
        : spectrum_(spectrum),
          disc_(light_on_disc(texels, axes, spectrum.cover(), spectrum.disc_cells())),
          samples_(texels.size()),
          azimuths_(azimuths),
          slices_(static_cast<std::size_t>(spectrum.even() ? azimuths / 2 : azimuths)) {}

    int pairs() const { return static_cast<int>(slices_.size() / 2); }
    /// Computes two slices that follow each other, unless they are known.
    void fill_pair(int pair) {
        const int first = 2 * pair;
        if (!slice_at(first).empty()) return;
        AzimuthPair both(spectrum_, samples_);
        for (int part = 0; part < 2; ++part)
            both.add_light(disc_, 2.0 * std::numbers::pi * (first + part) / azimuths_, part);
        both.correlate();
        for (int part = 0; part < 2; ++part) {
            slice_at(first + part).resize(texels());
            copy_slice(both, part, spectrum_.views(), kBestLinear, slice_at(first + part).data());
        }
    }
    /// Computes what value() needs at a slice.
    void fill_around(int slice) {
        const int count = static_cast<int>(slices_.size());
        for (int near = slice - 2; near <= slice + 2; ++near) fill_pair((near + count) % count / 2);
    }
    /// Sharpened by kBestLinear along the azimuth.
    glm::vec3 value(int slice, std::size_t texel) const {
        return sharpened(kBestLinear, {radiance(slice - 2, texel), radiance(slice - 1, texel), radiance(slice, texel),
                                       radiance(slice + 1, texel), radiance(slice + 2, texel)});
    }
    std::size_t texels() const {
        return static_cast<std::size_t>(spectrum_.views().g) * static_cast<std::size_t>(spectrum_.views().h);
    }

 private:
    std::vector<glm::vec3>& slice_at(int slice) { return slices_[static_cast<std::size_t>(slice)]; }
    /// A half turn further, both axes of the view are reversed.
    glm::vec3 radiance(int slice, std::size_t texel) const {
        const int count = static_cast<int>(slices_.size());
        const bool reversed = spectrum_.even() && (slice < 0 || slice >= count);
        const auto wrapped = static_cast<std::size_t>((slice + count) % count);
        return slices_[wrapped][reversed ? texels() - 1 - texel : texel];
    }

    const LobeSpectrum& spectrum_;
    LightDisc disc_;
    std::size_t samples_;
    int azimuths_;
    std::vector<std::vector<glm::vec3>> slices_;
};

LobeMap empty_map(const LobeSpectrum& spectrum, const glm::dvec3& normal, int azimuths) {
    ROWLAND_CHECK_OP(azimuths, >=, 8);
    ROWLAND_CHECK_OP(azimuths % 4, ==, 0);
    return {.size = {.azimuths = azimuths, .views = spectrum.views()},
            .half_turn = spectrum.even(),
            .axes = plane_axes(normal),
            .values = {}};
}

}  // namespace

LobeMap in_space(LobeMap map, const glm::dmat3& xyz_to_space) {
    const glm::mat3 to_space(xyz_to_space);
    for (glm::vec3& value : map.values) value = to_space * value;
    return map;
}

LobeMap fill_lobe_map(const lighting::LightSamples& texels, const LobeSpectrum& spectrum, const glm::dvec3& normal,
                      int azimuths, const std::stop_token& stop) {
    LobeMap map = empty_map(spectrum, normal, azimuths);
    LobeSlices filled(texels, spectrum, map.axes, azimuths);
    parallel_for(static_cast<std::size_t>(filled.pairs()), [&](std::size_t pair) {
        if (!stop.stop_requested()) filled.fill_pair(static_cast<int>(pair));
    });
    if (stop.stop_requested()) return map;
    const auto count = static_cast<std::size_t>(slices(map.size, map.half_turn));
    map.values.resize(count * filled.texels());
    parallel_for(count, [&](std::size_t slice) {
        glm::vec3* to = map.values.data() + slice * filled.texels();
        for (std::size_t texel = 0; texel < filled.texels(); ++texel)
            to[texel] = filled.value(static_cast<int>(slice), texel);
    });
    return map;
}

LobeMap fill_lobe_slice(const lighting::LightSamples& texels, const LobeSpectrum& spectrum, const glm::dvec3& normal,
                        const glm::dvec3& grating) {
    const glm::dvec3 n = glm::normalize(normal);
    const glm::dvec3 g = glm::normalize(grating - n * glm::dot(n, grating));
    LobeMap map{.size = {.azimuths = 1, .views = {.g = 2 * spectrum.views().g - 1, .h = 2 * spectrum.views().h - 1}},
                .half_turn = false,
                .axes = {glm::cross(g, n), g, n},
                .values = {}};
    const LobeMapViews& nodes = spectrum.views();
    std::vector<glm::vec3> coefficients(static_cast<std::size_t>(nodes.g) * static_cast<std::size_t>(nodes.h));
    AzimuthPair one(spectrum, texels.size());
    one.add_light(light_on_disc(texels, map.axes, spectrum.cover(), spectrum.disc_cells()), 0.5 * std::numbers::pi, 0);
    one.correlate();
    copy_slice(one, 0, nodes, kSplineBlur, coefficients.data());
    map.values = refined(coefficients, nodes, map.size.views);
    return map;
}

namespace {

/// Interpolates between the eight texels around a point: `value(slice, texel)`.
template <typename Value>
glm::dvec3 interpolate(const LobeMap& map, const ShadingPoint& frame, const Value& value) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 g(to_tangent[0][0], to_tangent[1][0], to_tangent[2][0]);
    double turns = std::atan2(glm::dot(g, map.axes.e2), glm::dot(g, map.axes.e1)) / (2.0 * std::numbers::pi);
    const double sign = map.half_turn && turns < 0.0 ? -1.0 : 1.0;
    if (turns < 0.0) turns += map.half_turn ? 0.5 : 1.0;
    const glm::dvec3 position(0.5 * (sign * v.x + 1.0) * (map.size.views.g - 1),
                              0.5 * (sign * v.y + 1.0) * (map.size.views.h - 1), turns * map.size.azimuths);
    const glm::ivec3 counts(map.size.views.g, map.size.views.h, slices(map.size, map.half_turn));
    const glm::dvec3 low = glm::floor(position);
    glm::dvec3 sum(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        glm::ivec3 at;
        for (int axis = 0; axis < 3; ++axis) {
            const int upper = corner >> axis & 1;
            const double t = position[axis] - low[axis];
            weight *= upper == 1 ? t : 1.0 - t;
            const int node = static_cast<int>(low[axis]) + upper;
            at[axis] = axis == 2 && !map.half_turn ? node % counts.z : std::clamp(node, 0, counts[axis] - 1);
        }
        const auto texel =
            static_cast<std::size_t>(at.y) * static_cast<std::size_t>(counts.x) + static_cast<std::size_t>(at.x);
        sum += weight * glm::dvec3(value(at.z, texel));
    }
    return sum;
}

}  // namespace

glm::dvec3 sample(const LobeMap& map, const ShadingPoint& frame) {
    const auto texels = static_cast<std::size_t>(map.size.views.g) * static_cast<std::size_t>(map.size.views.h);
    return interpolate(map, frame, [&](int slice, std::size_t texel) {
        return map.values[static_cast<std::size_t>(slice) * texels + texel];
    });
}

std::function<glm::dvec3(const ShadingPoint&)> lobe_map_of_points(const lighting::LightSamples& texels,
                                                                  const LobeSpectrum& spectrum,
                                                                  const glm::dvec3& normal, int azimuths) {
    const LobeMap map = empty_map(spectrum, normal, azimuths);
    const auto filled = std::make_shared<LobeSlices>(texels, spectrum, map.axes, azimuths);
    return [map, filled](const ShadingPoint& frame) {
        return interpolate(map, frame, [&](int slice, std::size_t texel) {
            filled->fill_around(slice);
            return filled->value(slice, texel);
        });
    };
}

}  // namespace rowland::diffraction

#include "modules/diffraction/representations/planar/planar_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>
#include <vector>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/bake/view_mapping.h"

namespace rowland::diffraction {

namespace {

/// The texels are summed in this many parts, whatever the number of threads.
constexpr std::size_t kParts = 4;

void splat(LightDisc& disc, float x, float y, const std::array<float, 4>& light) {
    const float last = static_cast<float>(disc.cells - 1);
    const float px = std::clamp(x, 0.0F, last);
    const float py = std::clamp(y, 0.0F, last);
    const int ix = std::min(static_cast<int>(px), disc.cells - 2);
    const int iy = std::min(static_cast<int>(py), disc.cells - 2);
    const float fx = px - static_cast<float>(ix);
    const float fy = py - static_cast<float>(iy);
    float* cell =
        disc.fluxes.data() +
        (static_cast<std::size_t>(iy) * static_cast<std::size_t>(disc.cells) + static_cast<std::size_t>(ix)) * 4;
    float* below = cell + static_cast<std::ptrdiff_t>(disc.cells) * 4;
    add_scaled(cell, light.data(), (1 - fx) * (1 - fy));
    add_scaled(cell + 4, light.data(), fx * (1 - fy));
    add_scaled(below, light.data(), (1 - fx) * fy);
    add_scaled(below + 4, light.data(), fx * fy);
}

/// Projects texels of the upper hemisphere along n: the measure on the disc is L ds_1 ds_2 = L s_n dω.
void add_texels(const lighting::LightSamples& texels, std::size_t begin, std::size_t end, const PlaneAxes& axes,
                const std::optional<Cover>& cover, LightDisc& disc) {
    const glm::vec3 e1(axes.e1);
    const glm::vec3 e2(axes.e2);
    const glm::vec3 n(axes.n);
    const float scale = 0.5F * static_cast<float>(disc.cells);
    for (std::size_t i = begin; i < end; ++i) {
        const float x = texels.x[i];
        const float y = texels.y[i];
        const float z = texels.z[i];
        const float s_n = x * n.x + y * n.y + z * n.z;
        if (!(s_n > 0.0F)) continue;
        const float weight = 0.5F * s_n * static_cast<float>(transmittance(cover, double{s_n}));
        const float s_1 = x * e1.x + y * e1.y + z * e1.z;
        const float s_2 = x * e2.x + y * e2.y + z * e2.z;
        splat(disc, (s_1 + 1.0F) * scale - 0.5F, (s_2 + 1.0F) * scale - 0.5F,
              {weight * texels.red[i], weight * texels.green[i], weight * texels.blue[i], 0.0F});
    }
}

}  // namespace

PlaneAxes plane_axes(const glm::dvec3& normal) {
    const glm::dvec3 n = glm::normalize(normal);
    const glm::dvec3 pole(0.0, n.y < 0.0 ? -1.0 : 1.0, 0.0);
    const glm::dvec3 e1 = glm::normalize(glm::dvec3(1.0, 0.0, 0.0) - n.x / (1.0 + glm::dot(pole, n)) * (pole + n));
    return {e1, glm::cross(n, e1), n};
}

std::pair<int, int> lit_columns(int cells, int row) {
    const double middle = 0.5 * (cells - 1);
    const double radius = 0.5 * cells;
    const double nearest = std::max(0.0, std::abs(row - middle) - 1.0);
    const double half = std::sqrt(std::max(0.0, radius * radius - nearest * nearest)) + 1.0;
    return {std::max(0, static_cast<int>(middle - half)), std::min(cells, static_cast<int>(middle + half) + 2)};
}

LightDisc light_on_disc(const lighting::LightSamples& texels, const PlaneAxes& axes, const std::optional<Cover>& cover,
                        int cells) {
    const auto floats = static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells) * 4;
    std::vector<LightDisc> parts(kParts);
    parallel_for(kParts, [&](std::size_t part) {
        parts[part] = {cells, std::vector<float>(floats, 0.0F)};
        add_texels(texels, texels.size() * part / kParts, texels.size() * (part + 1) / kParts, axes, cover,
                   parts[part]);
    });
    for (std::size_t part = 1; part < kParts; ++part)
        for (std::size_t i = 0; i < floats; ++i) parts[0].fluxes[i] += parts[part].fluxes[i];
    return std::move(parts[0]);
}

namespace {

using std::numbers::pi;

/// kBestLinear, and as much again for the light's spread over the azimuths between two nodes.
constexpr float kBestAzimuth = 2.0F * kBestLinear;

/// A(a) in cells of a, as flux: four floats (r, g, b, –) per cell.
using ArcCells = std::vector<float>;

/// The light of a plane seen along any g in it.
class LightProjection {
 public:
    LightProjection(const LightDisc& disc, double azimuth_step);

    /// A(a), averaged over the azimuths within half a step.
    ArcCells at(double azimuth) const;

 private:
    int cells_;
    double azimuth_step_;
    std::vector<float> rows_;     ///< of the disc
    std::vector<float> columns_;  ///< the same, transposed
};

LightProjection::LightProjection(const LightDisc& disc, double azimuth_step)
    : cells_(disc.cells), azimuth_step_(azimuth_step), rows_(disc.fluxes), columns_(disc.fluxes.size()) {
    const auto side = static_cast<std::size_t>(cells_);
    parallel_for(side, [&](std::size_t row) {
        for (std::size_t column = 0; column < side; ++column)
            std::copy_n(rows_.data() + (column * side + row) * 4, 4, columns_.data() + (row * side + column) * 4);
    });
}

ArcCells LightProjection::at(double azimuth) const {
    const double cosine = std::cos(azimuth);
    const double sine = std::sin(azimuth);
    // The inner loop runs along the axis where the cell of A changes fastest: consecutive sums are then independent.
    const bool along_rows = std::abs(cosine) >= std::abs(sine);
    const std::vector<float>& disc = along_rows ? rows_ : columns_;
    const auto inner = static_cast<float>(along_rows ? cosine : sine);
    const auto outer = static_cast<float>(along_rows ? sine : cosine);
    const auto half_step = static_cast<float>(0.5 * azimuth_step_);
    const auto side = static_cast<float>(cells_);
    const float middle = 0.5F * (side - 1.0F);
    // Where A changes from cell to cell: each texel's light begins and ends within two cells.
    ArcCells changes((static_cast<std::size_t>(cells_) + 2) * 4, 0.0F);
    const auto change_at = [&](float edge, const float* light, float density) {
        const int cell = static_cast<int>(edge);
        const float weight = edge - static_cast<float>(cell);
        float* to = changes.data() + static_cast<std::ptrdiff_t>(cell) * 4;
        add_scaled(to, light, (1.0F - weight) * density);
        add_scaled(to + 4, light, weight * density);
    };
    for (int row = 0; row < cells_; ++row) {
        const float y = static_cast<float>(row) - middle;
        const auto [begin, end] = lit_columns(cells_, row);
        const float* light = disc.data() + (static_cast<std::ptrdiff_t>(row) * cells_ + begin) * 4;
        for (int column = begin; column < end; ++column, light += 4) {
            const float x = static_cast<float>(column) - middle;
            // In cells from the first one's edge. A texel is as wide as a cell at least.
            const float centre = 0.5F * side + inner * x + outer * y;
            const float half = std::max(0.5F, std::abs(outer * x - inner * y) * half_step);
            const float first = std::clamp(centre - half, 0.0F, side - 1.0F);
            const float last = std::clamp(centre + half, first + 1.0F, side);
            const float density = 1.0F / (last - first);
            change_at(first, light, density);
            change_at(last, light, -density);
        }
    }
    ArcCells profile(static_cast<std::size_t>(cells_) * 4);
    std::array<double, 4> sum{};
    for (std::size_t i = 0; i < profile.size(); ++i) profile[i] = static_cast<float>(sum[i % 4] += changes[i]);
    return profile;
}

/// The arc profile of the azimuth half a turn further.
ArcCells mirrored(const ArcCells& profile) {
    ArcCells result(profile.size());
    for (std::size_t i = 0; i < profile.size(); i += 4)
        std::copy_n(profile.data() + i, 4, result.data() + result.size() - 4 - i);
    return result;
}

/// A map whose columns are computed one by one.
class PlanarMapFill {
 public:
    PlanarMapFill(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                  const glm::dvec3& normal, const PlanarMapSize& size, const glm::dmat3& zero_order_xyz,
                  const std::optional<Cover>& cover)
        : map_(empty_map(plane_axes(normal), size)),
          kernels_(kernels_of(map_, kernel, pitch_nm, zero_order_xyz)),
          step_(2.0 * pi / size.azimuths),
          light_(light_on_disc(texels, plane_axes(normal), cover, kernels_[0].cells()), step_),
          profiles_(static_cast<std::size_t>(size.azimuths) / 2) {}

    /// Number of projections: half the azimuths, since a rotation by π mirrors A.
    std::size_t projections() const { return profiles_.size(); }
    /// Computes the projection of an azimuth, unless it is known.
    void project(std::size_t azimuth) {
        ArcCells& profile = profiles_[azimuth % profiles_.size()];
        if (profile.empty()) profile = light_.at(step_ * static_cast<double>(azimuth % profiles_.size()));
    }
    /// Fills a column, once its projection and its neighbours' are known.
    void fill(std::size_t azimuth) {
        ArcCells here = profile_at(azimuth);
        const ArcCells before = profile_at(azimuth + azimuths() - 1);
        const ArcCells after = profile_at(azimuth + 1);
        for (std::size_t k = 0; k < here.size(); ++k) here[k] -= kBestAzimuth * (before[k] - 2.0F * here[k] + after[k]);
        const auto views = static_cast<std::size_t>(map_.views);
        std::vector<float> xyz(views * 4);
        for (std::size_t slice = 0; slice < kernels_.size(); ++slice) {
            kernels_[slice].correlate_rgb(here, xyz);
            for (std::size_t view = 0; view < views; ++view)
                map_.xyz[(slice * views + view) * azimuths() + azimuth] = {xyz[4 * view], xyz[4 * view + 1],
                                                                           xyz[4 * view + 2]};
        }
    }
    std::size_t azimuths() const { return static_cast<std::size_t>(map_.azimuths); }
    PlanarMap& map() { return map_; }

 private:
    static PlanarMap empty_map(const PlaneAxes& axes, const PlanarMapSize& size) {
        ROWLAND_CHECK_OP(size.azimuths, >=, 4);
        ROWLAND_CHECK_OP(size.azimuths % 2, ==, 0);
        ROWLAND_CHECK_OP(size.views, >=, 8);
        PlanarMap map{.azimuths = size.azimuths,
                      .views = size.views,
                      .e1 = axes.e1,
                      .e2 = axes.e2,
                      .n = axes.n,
                      .pitch = size.pitch,
                      .xyz = {}};
        map.xyz.resize(static_cast<std::size_t>(size.azimuths) * static_cast<std::size_t>(size.views) *
                           static_cast<std::size_t>(map.slices()),
                       glm::vec3(0.0F));
        return map;
    }
    /// The kernel of each slice of a map.
    static std::vector<KernelCells> kernels_of(const PlanarMap& map, const KernelTable& kernel, double pitch_nm,
                                               const glm::dmat3& zero_order_xyz) {
        std::vector<KernelCells> kernels;
        for (int slice = 0; slice < map.slices(); ++slice)
            kernels.emplace_back(kernel, map.pitch ? pitch_nm * map.pitch->factor_at(slice) : pitch_nm, map.views,
                                 zero_order_xyz);
        return kernels;
    }
    ArcCells profile_at(std::size_t azimuth) const {
        const ArcCells& profile = profiles_[azimuth % profiles_.size()];
        return azimuth / profiles_.size() % 2 == 0 ? profile : mirrored(profile);
    }

    PlanarMap map_;
    std::vector<KernelCells> kernels_;
    double step_;
    LightProjection light_;
    std::vector<ArcCells> profiles_;
};

/// Linear look-up that repeats; `position` ≥ 0, in columns.
AxisLookup look_up_repeating(double position, std::size_t count) {
    const double floor = std::floor(position);
    const std::size_t low = static_cast<std::size_t>(floor) % count;
    return {low, (low + 1) % count, position - floor};
}

}  // namespace

PlanarMap fill_planar_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const glm::dvec3& normal, const PlanarMapSize& size, const glm::dmat3& zero_order_xyz,
                          const std::optional<Cover>& cover, const std::stop_token& stop) {
    PlanarMapFill fill(texels, kernel, pitch_nm, normal, size, zero_order_xyz, cover);
    parallel_for(fill.projections(), [&](std::size_t i) {
        if (!stop.stop_requested()) fill.project(i);
    });
    if (stop.stop_requested()) return std::move(fill.map());
    parallel_for(fill.azimuths(), [&](std::size_t i) {
        if (!stop.stop_requested()) fill.fill(i);
    });
    return std::move(fill.map());
}

namespace {

AxisLookup look_up_azimuth(const PlanarMap& map, double azimuth) {
    const double turns = azimuth / (2.0 * pi);
    return look_up_repeating((turns - std::floor(turns)) * map.azimuths, static_cast<std::size_t>(map.azimuths));
}

/// The azimuth of a point's g.
double azimuth_of(const PlanarMap& map, const ShadingPoint& frame) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 g(to_tangent[0][0], to_tangent[1][0], to_tangent[2][0]);
    return std::atan2(glm::dot(g, map.e2), glm::dot(g, map.e1));
}

}  // namespace

std::function<glm::dvec3(const ShadingPoint&)> planar_map_of_points(const lighting::LightSamples& texels,
                                                                    const KernelTable& kernel, double pitch_nm,
                                                                    const glm::dvec3& normal, const PlanarMapSize& size,
                                                                    const glm::dmat3& zero_order_xyz,
                                                                    const std::optional<Cover>& cover) {
    const auto fill = std::make_shared<PlanarMapFill>(texels, kernel, pitch_nm, normal, size, zero_order_xyz, cover);
    return [fill, filled = std::vector<bool>(fill->azimuths())](const ShadingPoint& frame) mutable {
        const AxisLookup columns = look_up_azimuth(fill->map(), azimuth_of(fill->map(), frame));
        const std::array<std::size_t, 2> seen{columns.first, columns.second};
        if (!filled[seen[0]] || !filled[seen[1]]) {
            const std::size_t before = seen[0] + fill->azimuths() - 1;
            // Both columns and their neighbours; a small map has no more than its projections.
            parallel_for(std::min<std::size_t>(4, fill->projections()),
                         [&](std::size_t i) { fill->project(before + i); });
            parallel_for(2, [&](std::size_t i) { fill->fill(seen[i]); });
            filled[seen[0]] = filled[seen[1]] = true;
        }
        return sample(fill->map(), frame);
    };
}

glm::dvec3 sample(const PlanarMap& map, double azimuth, double v_g, double pitch_factor) {
    const auto azimuths = static_cast<std::size_t>(map.azimuths);
    const AxisLookup s = look_up_azimuth(map, azimuth);
    const AxisLookup t = look_up_axis(0.5 * (v_g + 1.0), static_cast<std::size_t>(map.views));
    const auto in_slice = [&](std::size_t slice) {
        const glm::vec3* values = map.xyz.data() + slice * static_cast<std::size_t>(map.views) * azimuths;
        const auto at = [&](std::size_t column, std::size_t row) {
            return glm::dvec3(values[row * azimuths + column]);
        };
        return glm::mix(glm::mix(at(s.first, t.first), at(s.second, t.first), s.weight),
                        glm::mix(at(s.first, t.second), at(s.second, t.second), s.weight), t.weight);
    };
    if (!map.pitch) return in_slice(0);
    const AxisLookup r = look_up_axis(map.pitch->position_of(pitch_factor), static_cast<std::size_t>(map.pitch->nodes));
    return glm::mix(in_slice(r.first), in_slice(r.second), r.weight);
}

glm::dvec3 sample(const PlanarMap& map, const ShadingPoint& frame, double pitch_factor) {
    const glm::dvec3 v = world_to_tangent(frame) * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    return sample(map, azimuth_of(map, frame), v.x, pitch_factor);
}

}  // namespace rowland::diffraction

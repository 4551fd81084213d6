#include "modules/diffraction/representations/planar/planar_map.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "modules/diffraction/bake/kernel_cells.h"
#include "modules/diffraction/bake/view_mapping.h"

namespace rowland::diffraction {

namespace {

using std::numbers::pi;

using Disc = std::vector<float>;

Disc transpose(const Disc& disc, int cells) {
    Disc result(disc.size());
    const auto side = static_cast<std::size_t>(cells);
    parallel_for(side, [&](std::size_t row) {
        for (std::size_t column = 0; column < side; ++column)
            std::copy_n(disc.data() + (column * side + row) * 4, 4, result.data() + (row * side + column) * 4);
    });
    return result;
}

/// `position` ≥ 0, in columns.
AxisLookup look_up_repeating(double position, std::size_t count) {
    const double floor = std::floor(position);
    const std::size_t low = static_cast<std::size_t>(floor) % count;
    return {low, (low + 1) % count, position - floor};
}

}  // namespace

/// A(a) in cells of a, as flux: four floats per cell.
struct PlanarFill::Profile {
    std::vector<float> cells;
};

PlanarFill::PlanarFill(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                       const glm::dvec3& normal, const PlanarMapSize& size, const glm::dmat3& zero_order_xyz,
                       const std::optional<Cover>& cover)
    : size_(size), cells_(2 * (size.views - 1)), kernel_(kernel, pitch_nm, size.views, zero_order_xyz) {
    ROWLAND_CHECK_OP(size.azimuths, >=, 4);
    ROWLAND_CHECK_OP(size.azimuths % 2, ==, 0);
    ROWLAND_CHECK_OP(size.views, >=, 8);
    axes_ = plane_axes(normal);
    rows_ = light_on_disc(texels, axes_, cover, cells_).fluxes;
    columns_ = transpose(rows_, cells_);
}

PlanarMap PlanarFill::empty() const {
    PlanarMap map{
        .azimuths = size_.azimuths, .views = size_.views, .e1 = axes_.e1, .e2 = axes_.e2, .n = axes_.n, .xyz = {}};
    map.xyz.resize(static_cast<std::size_t>(size_.azimuths) * static_cast<std::size_t>(size_.views), glm::vec3(0.0F));
    return map;
}

PlanarFill::Profile PlanarFill::project(int azimuth) const {
    const auto side = static_cast<std::size_t>(cells_);
    Profile profile{.cells = std::vector<float>((side + 1) * 4, 0.0F)};
    const double phi = 2.0 * pi * azimuth / size_.azimuths;
    const double cosine = std::cos(phi);
    const double sine = std::sin(phi);
    // The inner loop runs along the axis where the cell of A changes fastest: consecutive sums are then independent.
    const bool along_rows = std::abs(cosine) >= std::abs(sine);
    const Disc& disc = along_rows ? rows_ : columns_;
    const double inner = along_rows ? cosine : sine;
    const double outer = along_rows ? sine : cosine;
    const double middle = 0.5 * (cells_ - 1);
    const float last = static_cast<float>(cells_ - 1);
    for (int row = 0; row < cells_; ++row) {
        const double y = row - middle;
        const auto [begin, end] = lit_columns(cells_, row);
        const float start = static_cast<float>(outer * y + middle - inner * middle);
        const float step = static_cast<float>(inner);
        const float* light = disc.data() + (static_cast<std::size_t>(row) * side) * 4;
        for (int column = begin; column < end; ++column) {
            const float position = std::clamp(start + step * static_cast<float>(column), 0.0F, last);
            const int low = static_cast<int>(position);
            const float weight = position - static_cast<float>(low);
            float* to = profile.cells.data() + static_cast<std::ptrdiff_t>(low) * 4;
            const float* from = light + static_cast<std::ptrdiff_t>(column) * 4;
            add_scaled(to, from, 1.0F - weight);
            add_scaled(to + 4, from, weight);
        }
    }
    return profile;
}

PlanarFill::Profile PlanarFill::mirrored(const Profile& profile) const {
    Profile result{.cells = std::vector<float>(profile.cells.size(), 0.0F)};
    for (int cell = 0; cell < cells_; ++cell)
        std::copy_n(profile.cells.data() + static_cast<std::ptrdiff_t>(cell) * 4, 4,
                    result.cells.data() + static_cast<std::ptrdiff_t>(cells_ - 1 - cell) * 4);
    return result;
}

void PlanarFill::correlate(const Profile& profile, int azimuth, PlanarMap& map) const {
    std::vector<float> xyz(static_cast<std::size_t>(map.views) * 4);
    kernel_.correlate_rgb(profile.cells, xyz);
    for (int view = 0; view < map.views; ++view) {
        const float* from = xyz.data() + static_cast<std::ptrdiff_t>(view) * 4;
        map.xyz[static_cast<std::size_t>(view) * static_cast<std::size_t>(map.azimuths) +
                static_cast<std::size_t>(azimuth)] = {from[0], from[1], from[2]};
    }
}

void PlanarFill::fill(int begin, int end, PlanarMap& map, const std::stop_token& stop) const {
    ROWLAND_CHECK(map.azimuths == size_.azimuths && map.views == size_.views, "a map of another size");
    ROWLAND_CHECK(begin >= 0 && begin <= end && end <= size_.azimuths, "azimuths outside the map");
    map.e1 = axes_.e1;
    map.e2 = axes_.e2;
    map.n = axes_.n;
    const int half_turn = size_.azimuths / 2;
    const auto wrap = [](int i, int count) { return (i % count + count) % count; };
    // A rotation by π mirrors A: half of the projections suffice.
    std::vector<char> needed(static_cast<std::size_t>(half_turn), 0);
    for (int azimuth = begin - 1; azimuth <= end; ++azimuth)
        if (begin < end) needed[static_cast<std::size_t>(wrap(azimuth, half_turn))] = 1;
    std::vector<Profile> profiles(needed.size());
    parallel_for(needed.size(), [&](std::size_t i) {
        if (needed[i] != 0 && !stop.stop_requested()) profiles[i] = project(static_cast<int>(i));
    });
    if (stop.stop_requested()) return;
    const auto profile_at = [&](int azimuth) {
        const Profile& profile = profiles[static_cast<std::size_t>(wrap(azimuth, half_turn))];
        return wrap(azimuth, size_.azimuths) < half_turn ? profile : mirrored(profile);
    };
    parallel_for(static_cast<std::size_t>(end - begin), [&](std::size_t i) {
        if (stop.stop_requested()) return;
        const int azimuth = begin + static_cast<int>(i);
        Profile here = profile_at(azimuth);
        const Profile before = profile_at(azimuth - 1);
        const Profile after = profile_at(azimuth + 1);
        for (std::size_t k = 0; k < here.cells.size(); ++k)
            here.cells[k] -= kBestLinear * (before.cells[k] - 2.0F * here.cells[k] + after.cells[k]);
        correlate(here, azimuth, map);
    });
}

PlanarMap fill_planar_map(const lighting::LightSamples& texels, const KernelTable& kernel, double pitch_nm,
                          const glm::dvec3& normal, const PlanarMapSize& size, const glm::dmat3& zero_order_xyz,
                          const std::optional<Cover>& cover, const std::stop_token& stop) {
    const PlanarFill fill(texels, kernel, pitch_nm, normal, size, zero_order_xyz, cover);
    PlanarMap map = fill.empty();
    fill.fill(0, size.azimuths, map, stop);
    return map;
}

glm::dvec3 sample(const PlanarMap& map, double azimuth, double v_g) {
    const double turns = azimuth / (2.0 * pi);
    const auto azimuths = static_cast<std::size_t>(map.azimuths);
    const AxisLookup s = look_up_repeating((turns - std::floor(turns)) * map.azimuths, azimuths);
    const AxisLookup t = look_up_axis(0.5 * (v_g + 1.0), static_cast<std::size_t>(map.views));
    const auto at = [&](std::size_t column, std::size_t row) { return glm::dvec3(map.xyz[row * azimuths + column]); };
    return glm::mix(glm::mix(at(s.first, t.first), at(s.second, t.first), s.weight),
                    glm::mix(at(s.first, t.second), at(s.second, t.second), s.weight), t.weight);
}

glm::dvec3 sample(const PlanarMap& map, const ShadingPoint& frame) {
    const glm::dmat3 to_tangent = world_to_tangent(frame);
    const glm::dvec3 v = to_tangent * glm::normalize(frame.view);
    if (v.z <= 0.0) return glm::dvec3(0.0);
    const glm::dvec3 g(to_tangent[0][0], to_tangent[1][0], to_tangent[2][0]);
    return sample(map, std::atan2(glm::dot(g, map.e2), glm::dot(g, map.e1)), v.x);
}

}  // namespace rowland::diffraction

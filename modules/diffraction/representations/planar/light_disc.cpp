#include "modules/diffraction/representations/planar/light_disc.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

#include "engine/core/parallel.h"

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

}  // namespace rowland::diffraction

#include "engine/lighting/light_texels.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

#include "engine/core/check.h"
#include "engine/core/parallel.h"
#include "engine/lighting/environment_map.h"

namespace rowland::lighting {

namespace {

/// κ(1 − cos) beyond which a lobe's density, at most exp(−this) of its peak, is left out.
constexpr double kLobeReach = 30.0;

/// The probe, each texel cut into parts × parts, with the bilinear lookup's radiance.
ProbeImage cut_texels(const ProbeImage& probe, int parts) {
    image::Image fine{.width = probe.image().width * parts, .height = probe.image().height * parts, .texels = {}};
    fine.texels.resize(static_cast<std::size_t>(fine.width) * static_cast<std::size_t>(fine.height));
    parallel_for(static_cast<std::size_t>(fine.height), [&](std::size_t row) {
        for (int column = 0; column < fine.width; ++column) {
            const double x = (column + 0.5) / parts;
            const double y = (static_cast<double>(row) + 0.5) / parts;
            fine.at(column, static_cast<int>(row)) = glm::vec3(probe.radiance(probe.direction(x, y)));
        }
    });
    return {std::move(fine), probe.mapping()};
}

/// Side of the probe's largest texels in radians: 2π of the width at the equator, or along the angular map's radius.
double texel_side(const ProbeImage& probe) {
    return 2.0 * std::numbers::pi / probe.image().width;
}

LightTexels texels_of(const ProbeImage& probe) {
    const auto width = static_cast<std::size_t>(probe.image().width);
    const auto height = static_cast<std::size_t>(probe.image().height);
    LightTexels texels;
    for (auto* array : {&texels.x, &texels.y, &texels.z, &texels.red, &texels.green, &texels.blue})
        array->assign(width * height, 0.0F);
    parallel_for(height, [&](std::size_t row) {
        const int r = static_cast<int>(row);
        const bool even_rows = probe.mapping() == Mapping::Equirectangular;
        double solid_angle = even_rows ? probe.solid_angle(0, r) : 0.0;
        for (std::size_t column = 0; column < width; ++column) {
            const int c = static_cast<int>(column);
            if (!even_rows) solid_angle = probe.solid_angle(c, r);
            const std::size_t i = row * width + column;
            const glm::vec3 s(probe.direction(c + 0.5, r + 0.5));
            const glm::vec3 flux(solid_angle * glm::dvec3(probe.image().at(c, r)));
            texels.x[i] = s.x;
            texels.y[i] = s.y;
            texels.z[i] = s.z;
            texels.red[i] = flux.x;
            texels.green[i] = flux.y;
            texels.blue[i] = flux.z;
        }
    });
    return texels;
}

/// The lobe's flux in each texel that it reaches, as shares that sum to 1.
struct LobeShares {
    std::vector<std::size_t> texels;
    std::vector<double> shares;
};

LobeShares lobe_shares(const KeyLight& key, const LightTexels& texels, const ProbeImage& probe) {
    LobeShares result;
    double sum = 0.0;
    std::size_t nearest = 0;
    double nearest_cosine = -2.0;
    const auto width = static_cast<std::size_t>(probe.image().width);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 s(texels.x[i], texels.y[i], texels.z[i]);
        const double cosine = glm::dot(s, key.direction);
        const bool reached = key.concentration * (1.0 - cosine) < kLobeReach;
        if (!reached && cosine <= nearest_cosine) continue;
        const double solid_angle = probe.solid_angle(static_cast<int>(i % width), static_cast<int>(i / width));
        if (solid_angle <= 0.0) continue;
        if (cosine > nearest_cosine) {
            nearest_cosine = cosine;
            nearest = i;
        }
        if (!reached) continue;
        result.texels.push_back(i);
        result.shares.push_back(lobe_density(key, s) * solid_angle);
        sum += result.shares.back();
    }
    // A lobe so narrow that it falls between texel centres lies in the nearest.
    if (!(sum > 1e-3)) return {{nearest}, {1.0}};
    for (double& share : result.shares) share /= sum;
    return result;
}

}  // namespace

LightTexels light_texels(const ProbeImage& probe, std::span<const KeyLight> keys, double largest_side) {
    ROWLAND_CHECK_OP(largest_side, >, 0.0);
    const int parts = static_cast<int>(std::ceil(texel_side(probe) / largest_side - 1e-9));
    const ProbeImage cut = parts > 1 ? cut_texels(probe, parts) : probe;
    LightTexels texels = texels_of(cut);
    std::vector<LobeShares> lobes(keys.size());
    parallel_for(keys.size(), [&](std::size_t k) { lobes[k] = lobe_shares(keys[k], texels, cut); });
    for (std::size_t k = 0; k < keys.size(); ++k)
        for (std::size_t j = 0; j < lobes[k].texels.size(); ++j) {
            const std::size_t i = lobes[k].texels[j];
            const glm::vec3 taken(lobes[k].shares[j] * keys[k].flux);
            texels.red[i] -= taken.x;
            texels.green[i] -= taken.y;
            texels.blue[i] -= taken.z;
        }
    return texels;
}

LightTexels gather_texels(const LightTexels& texels, int face_size) {
    ROWLAND_CHECK_OP(face_size, >=, 1);
    struct Cell {
        glm::dvec3 flux{0.0};
        glm::dvec3 place{0.0};
    };
    const auto side = static_cast<std::size_t>(face_size);
    std::vector<Cell> cells(6 * side * side);
    const auto index = [&](double at) {
        return static_cast<std::size_t>(std::clamp(static_cast<int>(0.5 * (at + 1.0) * face_size), 0, face_size - 1));
    };
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const glm::dvec3 flux(texels.red[i], texels.green[i], texels.blue[i]);
        const double magnitude = std::abs(flux.x) + std::abs(flux.y) + std::abs(flux.z);
        if (magnitude == 0.0) continue;
        const glm::dvec3 s(texels.x[i], texels.y[i], texels.z[i]);
        const CubePoint point = cube_point(s);
        Cell& cell = cells[(static_cast<std::size_t>(point.face) * side + index(point.t)) * side + index(point.s)];
        cell.flux += flux;
        cell.place += magnitude * s;
    }
    LightTexels gathered;
    for (const Cell& cell : cells) {
        if (cell.place == glm::dvec3(0.0)) continue;
        const glm::vec3 s(glm::normalize(cell.place));
        gathered.x.push_back(s.x);
        gathered.y.push_back(s.y);
        gathered.z.push_back(s.z);
        gathered.red.push_back(static_cast<float>(cell.flux.x));
        gathered.green.push_back(static_cast<float>(cell.flux.y));
        gathered.blue.push_back(static_cast<float>(cell.flux.z));
    }
    return gathered;
}

}  // namespace rowland::lighting

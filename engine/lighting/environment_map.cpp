#include "engine/lighting/environment_map.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/core/check.h"
#include "engine/lighting/scaled_halves.h"

namespace rowland::lighting {

namespace {

/// Solid angle of the rectangle (0,0)–(s,t) of a cube face at distance 1 [Ström & Akenine-Möller; arctan form].
double corner_solid_angle(double s, double t) {
    return std::atan2(s * t, std::sqrt(s * s + t * t + 1));
}

}  // namespace

std::size_t CubeLayout::offset(int level) const {
    std::size_t sum = 0;
    for (int k = 0; k < level; ++k) {
        const auto side = static_cast<std::size_t>(size(k));
        sum += 6 * side * side;
    }
    return sum;
}

std::size_t CubeLayout::index(int level, int face, int column, int row) const {
    const auto side = static_cast<std::size_t>(size(level));
    return offset(level) + (static_cast<std::size_t>(face) * side + static_cast<std::size_t>(row)) * side +
           static_cast<std::size_t>(column);
}

glm::dvec3 cube_direction(int face, double s, double t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        case 5:
            return {-s, -t, -1};
        default:
            ROWLAND_CHECK(false, "a cube has six faces");
            return {};
    }
}

CubePoint cube_point(const glm::dvec3& d) {
    const double x = std::abs(d.x);
    const double y = std::abs(d.y);
    const double z = std::abs(d.z);
    if (x >= y && x >= z) return d.x > 0 ? CubePoint{0, -d.z / x, -d.y / x} : CubePoint{1, d.z / x, -d.y / x};
    if (y >= z) return d.y > 0 ? CubePoint{2, d.x / y, d.z / y} : CubePoint{3, d.x / y, -d.z / y};
    return d.z > 0 ? CubePoint{4, d.x / z, -d.y / z} : CubePoint{5, -d.x / z, -d.y / z};
}

double cube_solid_angle(int size, int column, int row) {
    const double step = 2.0 / size;
    const double s = column * step - 1;
    const double t = row * step - 1;
    return corner_solid_angle(s, t) - corner_solid_angle(s + step, t) - corner_solid_angle(s, t + step) +
           corner_solid_angle(s + step, t + step);
}

PackedEnvironmentMap pack(const EnvironmentMap& map) {
    ROWLAND_CHECK_OP(map.texels.size(), ==, map.layout.offset(map.layout.levels));
    float largest = 0;
    for (const glm::vec3& texel : map.texels)
        for (int c = 0; c < 3; ++c) {
            ROWLAND_CHECK(std::isfinite(texel[c]) && texel[c] >= 0, "an environment map holds finite light");
            largest = std::max(largest, texel[c]);
        }
    PackedEnvironmentMap packed;
    packed.layout = map.layout;
    packed.scale = half_scale(largest);
    packed.halves.reserve(3 * map.texels.size());
    for (const glm::vec3& texel : map.texels)
        for (int c = 0; c < 3; ++c) packed.halves.push_back(to_half(texel[c], packed.scale));
    return packed;
}

EnvironmentMap unpack(const PackedEnvironmentMap& packed) {
    EnvironmentMap map;
    map.layout = packed.layout;
    map.texels.resize(packed.halves.size() / 3);
    for (std::size_t i = 0; i < map.texels.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            map.texels[i][static_cast<int>(c)] = from_half(packed.halves[3 * i + c]) * packed.scale;
    return map;
}

}  // namespace rowland::lighting

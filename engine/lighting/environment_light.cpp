#include "engine/lighting/environment_light.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace rowland::lighting {

namespace {

/// A texel, which may lie a column or a row beyond a face's edge: then the next face's.
glm::dvec3 texel(const EnvironmentMap& map, int level, int face, int column, int row) {
    const int size = map.layout.size(level);
    if (std::min(column, row) < 0 || std::max(column, row) >= size) {
        const CubePoint beyond =
            cube_point(cube_direction(face, (2.0 * column + 1.0) / size - 1.0, (2.0 * row + 1.0) / size - 1.0));
        face = beyond.face;
        column = std::clamp(static_cast<int>((beyond.s + 1.0) / 2.0 * size), 0, size - 1);
        row = std::clamp(static_cast<int>((beyond.t + 1.0) / 2.0 * size), 0, size - 1);
    }
    return glm::dvec3(map.texels[map.layout.index(level, face, column, row)]);
}

glm::dvec3 between_texels(const EnvironmentMap& map, int level, const glm::dvec3& direction) {
    const CubePoint point = cube_point(direction);
    const int size = map.layout.size(level);
    const double x = (point.s + 1.0) / 2.0 * size - 0.5;
    const double y = (point.t + 1.0) / 2.0 * size - 0.5;
    const auto column = static_cast<int>(std::floor(x));
    const auto row = static_cast<int>(std::floor(y));
    const auto in_row = [&](int r) {
        return glm::mix(texel(map, level, point.face, column, r), texel(map, level, point.face, column + 1, r),
                        x - column);
    };
    return glm::mix(in_row(row), in_row(row + 1), y - row);
}

}  // namespace

glm::dvec3 environment_light(const EnvironmentMap& map, const glm::dvec3& direction, double roughness) {
    const int last = map.layout.levels - 1;
    const double even = roughness * last;
    const double level = std::min(even * std::min(even, 1.0), static_cast<double>(last));
    const int first = std::min(static_cast<int>(level), std::max(last - 1, 0));
    const glm::dvec3 light = between_texels(map, first, direction);
    return last == 0 ? light : glm::mix(light, between_texels(map, first + 1, direction), level - first);
}

glm::dvec3 lobe_direction(const glm::dvec3& n, const glm::dvec3& v, double roughness) {
    return glm::mix(glm::reflect(-v, n), n, std::pow(roughness, 3.0));
}

}  // namespace rowland::lighting

#pragma once

#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "engine/lighting/probe_image.h"

namespace rowland::test {

/// A probe whose texels are `light` at their centres; an angular map's corners hold NaN-free rubbish that must not
/// leak.
inline lighting::ProbeImage made_probe(lighting::Mapping mapping, int height,
                                       const std::function<glm::dvec3(const glm::dvec3&)>& light) {
    const int width = mapping == lighting::Mapping::Angular ? height : 2 * height;
    image::Image image{width, height, {}};
    image.texels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::vec3(1e6f));
    const lighting::ProbeImage empty(image, mapping);
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < width; ++column) {
            const double u = (2 * column + 1.0) / width - 1;
            const double v = (2 * row + 1.0) / height - 1;
            if (mapping == lighting::Mapping::Angular && u * u + v * v > 1) continue;
            image.at(column, row) = glm::vec3(light(empty.direction(column + 0.5, row + 0.5)));
        }
    return {std::move(image), mapping};
}

inline lighting::ProbeImage constant_probe(lighting::Mapping mapping, int height) {
    return made_probe(mapping, height, [](const glm::dvec3&) { return glm::dvec3(1.0); });
}

inline const lighting::Mapping kMappings[] = {lighting::Mapping::Equirectangular, lighting::Mapping::Angular};

/// Unit vectors all over the sphere.
inline glm::dvec3 spread_direction(int i, int count) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double phi = 2 * std::numbers::pi * i * std::numbers::phi;
    const double r = std::sqrt(1 - z * z);
    return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace rowland::test

#pragma once

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <string>
#include <vector>

#include "engine/lighting/light_probe.h"
#include "engine/math/spherical_harmonics.h"

namespace rowland::test {

/// A surface's normal and the direction to who sees it.
struct Facing {
    glm::dvec3 n;
    glm::dvec3 v;
};

/// Normals everywhere, seen at up to 70 degrees; the same at each call.
inline std::vector<Facing> random_facings(int count) {
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    const auto direction = [&] {
        glm::dvec3 result;
        for (int i = 2; i >= 0; --i) result[i] = normal(generator);  // arguments of a call have no order
        return glm::normalize(result);
    };
    std::vector<Facing> facings;
    while (facings.size() < static_cast<std::size_t>(count)) {
        const Facing facing{direction(), direction()};
        if (glm::dot(facing.n, facing.v) > 0.34) facings.push_back(facing);
    }
    return facings;
}

/// A recipe of a clear sky's probe that is so small that the reference is quick under it; `width` in texels.
inline std::string small_sky(int width, int key_lights = 16) {
    return fmt::format(R"({{"probe": {{"type": "clear_sky", "sun_azimuth_deg": 40, "sun_elevation_deg": 35, "width": {},
                            "key_lights": {}}}}})",
                       width, key_lights);
}

/// E(n)/π for the unit normal.
inline glm::dvec3 evaluate_irradiance(const lighting::AmbientLight& ambient, const glm::dvec3& normal) {
    std::array<double, 9> values{};
    math::evaluate_sh(normal, 3, values);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * ambient.coefficients[i];
    return sum;
}

}  // namespace rowland::test

#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

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
        return glm::normalize(glm::dvec3(normal(generator), normal(generator), normal(generator)));
    };
    std::vector<Facing> facings;
    while (facings.size() < static_cast<std::size_t>(count)) {
        const Facing facing{direction(), direction()};
        if (glm::dot(facing.n, facing.v) > 0.34) facings.push_back(facing);
    }
    return facings;
}

}  // namespace rowland::test

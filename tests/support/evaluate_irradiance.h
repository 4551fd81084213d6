#pragma once

#include <array>
#include <cstddef>

#include "engine/lighting/ambient.h"
#include "engine/math/sh_basis.h"

namespace rowland::test {

/// E(n)/π for the unit normal.
inline glm::dvec3 evaluate_irradiance(const lighting::AmbientLight& ambient, const glm::dvec3& normal) {
    std::array<double, 9> values{};
    math::evaluate_sh(normal, 3, values);
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * ambient.coefficients[i];
    return sum;
}

}  // namespace rowland::test

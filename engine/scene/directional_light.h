#pragma once

#include <glm/vec3.hpp>

namespace rowland::scene {

/// Component: a distant small light, as the sun.
struct DirectionalLight {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit, world, toward the light
    glm::vec3 irradiance{0.0F};             ///< on a surface that faces it; linear Rec.709/D65, the probe's scale
};

}  // namespace rowland::scene

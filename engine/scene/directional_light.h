#pragma once

#include <glm/vec3.hpp>

namespace rowland::scene {

/// Component: a distant light, such as the sun.
struct DirectionalLight {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit, toward the light; its entity's WorldMatrix, if any, turns it
    glm::vec3 irradiance{0.0F};             ///< on a surface that faces it; linear Rec.709/D65, the probe's scale
    bool casts_shadow = false;              ///< for at most one light
};

}  // namespace rowland::scene

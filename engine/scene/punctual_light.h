#pragma once

#include <glm/vec3.hpp>

namespace rowland::scene {

/// Component: a light at a point, at its entity's WorldMatrix; a spot shines along that matrix's −Z.
struct PunctualLight {
    glm::vec3 intensity{0.0F};  ///< irradiance at 1 m, linear Rec.709/D65, the probe's scale
    float range_m = 0.0F;       ///< where it ends (glTF's window); 0: never
    bool spot = false;
    float inner_cone = 0.0F;          ///< radians from the axis, full light inside
    float outer_cone = 0.785398163F;  ///< radians from the axis, dark outside; > inner_cone
};

/// Share of `intensity`/distance² that reaches a point: glTF's range window max(0, 1 − (distance/range)⁴) and a spot's
/// cone (KHR_lights_punctual). `cos_axis`: cosine between the axis and the direction to the point.
float attenuation(const PunctualLight& light, float distance_m, float cos_axis);

}  // namespace rowland::scene

#pragma once

#include <glm/vec3.hpp>

namespace rowland::scene {

inline constexpr float kSunAngularRadius = 0.00465F;  ///< radians, seen from the Earth
inline constexpr float kBulbRadius_m = 0.03F;

/// Component: a distant light, such as the sun.
struct DirectionalLight {
    glm::vec3 direction{0.0F, 1.0F, 0.0F};  ///< unit, toward the light; its entity's WorldMatrix, if any, turns it
    glm::vec3 irradiance{0.0F};             ///< on a surface that faces it; linear Rec.709/D65, the probe's scale
    float angular_radius = 0.0F;            ///< of the light's disc, radians
    bool casts_shadow = false;              ///< of all lights with it, only the first does
};

/// Component: a sphere about the origin of its entity's WorldMatrix, or a spot that shines along that matrix's −Z.
struct PunctualLight {
    glm::vec3 intensity{0.0F};  ///< irradiance at 1 m, linear Rec.709/D65, the probe's scale
    float radius_m = 0.0F;      ///< 0: a point
    float range_m = 0.0F;       ///< where it ends (glTF's window); 0: never
    bool spot = false;
    float inner_cone = 0.0F;          ///< radians from the axis, full light inside
    float outer_cone = 0.785398163F;  ///< radians from the axis, dark outside; > inner_cone
};

}  // namespace rowland::scene

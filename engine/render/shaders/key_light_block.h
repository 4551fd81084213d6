// The probe's key lights: von Mises-Fisher lobes, taken out of FrameBlock's ambient light. Zero of them, and no define
// KEY_LIGHTS, where the renderer does without. Included by C++ and GLSL; std140.
#ifdef __cplusplus
#pragma once
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::vec4;
#endif
#define ROWLAND_MAXIMUM_KEY_LIGHTS 64
struct KeyLightEntry {
    vec4 direction;   // xyz: unit, world, toward the light; w: mean of s.direction over the lobe
    vec4 flux;        // xyz: radiance * sr, linear Rec.709; w: concentration kappa
    vec4 irradiance;  // xyz: the same flux in the working space: irradiance of what faces it; w: variance of
                      // s.direction over the lobe
    vec4 spread;      // x: variance of s along any axis across the direction
};
#ifdef __cplusplus
struct KeyLightBlock {
#else
layout(std140, binding = 3) uniform KeyLightBlock {
#endif
    vec4 key_light_count;  // x
    KeyLightEntry key_lights[ROWLAND_MAXIMUM_KEY_LIGHTS];
#ifdef __cplusplus
};
static_assert(sizeof(KeyLightBlock) == 16 + 64 * ROWLAND_MAXIMUM_KEY_LIGHTS, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

// The scene's lights, the directional ones first. Included by C++ and GLSL; std140.
#ifdef __cplusplus
#pragma once
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::vec4;
#endif
#define ROWLAND_MAXIMUM_LIGHTS 64
struct Light {
    vec4 position;  // xyz: unit direction toward a directional light, else metres; w: 1 / range^4, or 0 without a range
    vec4 strength;  // xyz: irradiance, for points and spots at 1 m; working space
    // Of a spot: xyz: where it shines, times a scale, and w: an offset, which take the cosine from the axis to 0 outside
    // the cone and to 1 in the inner one. Of a point: 0, 0, 0, 1.
    vec4 axis;
};
#ifdef __cplusplus
struct LightBlock {
#else
#include "engine/gpu/shaders/dialect.glsl"
BLOCK_BINDING(2) uniform LightBlock {
#endif
    vec4 light_counts;  // x: directional; y: all
    Light lights[ROWLAND_MAXIMUM_LIGHTS];
#ifdef __cplusplus
};
static_assert(sizeof(LightBlock) == 16 + 48 * ROWLAND_MAXIMUM_LIGHTS, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

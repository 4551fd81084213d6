// What every shader of a frame may read. Included by C++ and GLSL; std140, so vec4 and mat4 only.
#ifdef __cplusplus
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::mat4;
using glm::vec4;
struct FrameBlock {
#else
layout(std140, binding = 0) uniform FrameBlock {
#endif
    mat4 view_projection;
    mat4 clip_to_world;   // inverse of the projection and the camera's rotation, without its translation
    vec4 eye;             // xyz: world position, metres
    vec4 ambient[9];      // xyz: SH of irradiance / pi, working space
    vec4 key_direction;   // xyz: unit, toward the directional light
    vec4 key_irradiance;  // xyz: working space
    vec4 environment;     // x: mip levels - 1; y: radiance per stored unit
    mat4 xyz_to_working;  // upper 3x3
#ifdef __cplusplus
};
static_assert(sizeof(FrameBlock) == 3 * 64 + 13 * 16, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

// The plane that mirrors show: engine/render/local_reflection.h. Included by C++ and GLSL; std140.
#ifdef __cplusplus
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::mat4;
using glm::vec4;
struct ReflectionBlock {
#else
#include "engine/gpu/shaders/dialect.glsl"
BLOCK_BINDING(3) uniform ReflectionBlock {
#endif
    mat4 world_to_plane;   // x, z: along the plane from its middle; y: above it
    vec4 plane_size;       // xy: half of its sides; z: angle of a pixel, radians; w: 1 if it has a map
    vec4 plane_normal;     // xyz: unit, world; w: perceptual roughness
    vec4 plane_ambient;    // xyz: radiance if it were white, without the light that casts shadows; working space
    vec4 plane_lamp;       // xyz: radiance if it were white, of that light
    vec4 plane_colour;     // xyz: as ObjectBlock's base_colour
    vec4 plane_uv_linear;  // columns of the 2x2 part of x, z to texture coordinates
    vec4 plane_uv_offset;  // xy
#ifdef __cplusplus
};
static_assert(sizeof(ReflectionBlock) == 64 + 7 * 16, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

// Per-frame data for every shader. Included by C++ and GLSL; std140, so vec4 and mat4 only.
#ifdef __cplusplus
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::mat4;
using glm::vec4;
struct FrameBlock {
#else
#include "engine/gpu/shaders/dialect.glsl"
BLOCK_BINDING(0) uniform FrameBlock {
#endif
    mat4 view_projection;
    mat4 clip_to_world;      // inverse of the projection and the camera's rotation, without its translation
    mat4 world_to_shadow;    // clip space of the shadow map; parallel, so w stays 1
    mat4 xyz_to_working;     // upper 3x3
    mat4 rec709_to_working;  // upper 3x3
    vec4 eye;                // xyz: world position, metres
    vec4 ambient[9];         // xyz: SH of irradiance / pi, working space; without the key lights
    vec4 environment;        // x: mip levels - 1; y: radiance per stored unit; z: irradiance per unit of
                             // key_irradiance_map
    vec4 shadow;             // x: width of a shadow texel, metres; y: of the map, 1 / texels; z: 1 if the target holds
                             // half floats; w: of soft shadows: engine/render/soft_shadow.h
    vec4 dome;               // x: height of the probe's camera above the floor y = 0, metres; y: radius; 0: none;
                             // zw: 1 / pixels of the picture
#ifdef __cplusplus
};
static_assert(sizeof(FrameBlock) == 5 * 64 + 13 * 16, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

// Per-object data. Included by C++ and GLSL; std140.
#ifdef __cplusplus
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::mat4;
using glm::vec4;
struct ObjectBlock {
#else
#include "engine/gpu/shaders/dialect.glsl"
BLOCK_BINDING(1) uniform ObjectBlock {
#endif
    mat4 object_to_world;
    mat4 normal_to_world;     // inverse transpose of the upper 3x3
    vec4 base_colour;         // xyz: working space, or Rec.709 where a texture or vertex colours multiply it; w: alpha
    vec4 metallic_roughness;  // x: metallic; y: perceptual roughness; z: alpha cutoff; w: strength of the clear coat
    vec4 emissive;            // xyz: radiance, working space, or Rec.709 where a texture multiplies it; w: perceptual
                              // roughness of the clear coat
    vec4 map_strength;        // x: normal scale; y: occlusion strength; z: sign of object_to_world's determinant;
                              // w: the object's first joint matrix
    vec4 uv_linear[5];        // of each map (base colour, metallic-roughness, normal, occlusion, emissive): the 2x2
                              // part of its texture transform, column after column
    vec4 uv_offset[5];        // xy
#ifdef __cplusplus
};
static_assert(sizeof(ObjectBlock) == 2 * 64 + 14 * 16, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

// What is particular to one drawn object. Included by C++ and GLSL; std140.
#ifdef __cplusplus
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
namespace rowland::render {
using glm::mat4;
using glm::vec4;
struct ObjectBlock {
#else
layout(std140, binding = 1) uniform ObjectBlock {
#endif
    mat4 object_to_world;
    mat4 normal_to_world;     // inverse transpose of the upper 3x3
    vec4 base_colour;         // xyz: working space
    vec4 metallic_roughness;  // x: metallic; y: perceptual roughness
#ifdef __cplusplus
};
static_assert(sizeof(ObjectBlock) == 2 * 64 + 2 * 16, "must equal the std140 layout");
}  // namespace rowland::render
#else
};
#endif

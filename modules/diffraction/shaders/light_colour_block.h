// The colour of each of the engine's lights[]. Included by C++ and GLSL; std140.
#include "engine/render/shaders/light_block.h"
#ifdef __cplusplus
#pragma once
#include <glm/vec4.hpp>
namespace rowland::diffraction {
using glm::vec4;
struct LightColourBlock {
#else
BLOCK_BINDING(7) uniform LightColourBlock {
#endif
    vec4 light_colours[ROWLAND_MAXIMUM_LIGHTS];  // x: its colour's layer of the kernel table; y: the light's strength
                                                 // over that colour
#ifdef __cplusplus
};
static_assert(sizeof(LightColourBlock) == 16 * ROWLAND_MAXIMUM_LIGHTS, "must equal the std140 layout");
}  // namespace rowland::diffraction
#else
};
#endif

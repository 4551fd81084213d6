// The key lights of a frame, with the numbers of their lobes that do not depend on the surface, and the colours of the
// scene's lights. Included by C++ and GLSL; std140.
#ifdef __cplusplus
#pragma once
#include <glm/vec4.hpp>

#include "engine/render/shaders/scene_blocks.h"
#define ROWLAND_BLOCK(point, name) struct name
#define SMALL_LIGHTS
namespace rowland::diffraction {
using glm::vec4;
#endif
#define ROWLAND_MAXIMUM_KEY_LOBES 64
// Rows of a light's table: direct/lobe_table.h.
#define ROWLAND_LOBE_TABLE_OCTAVES 28
#define ROWLAND_LOBE_TABLE_START (-18)
// key_light_windows.glsl: windows on either side of the middle, and the step between them in deviations.
#define ROWLAND_LOBE_WINDOWS 6
#define ROWLAND_LOBE_WINDOW_STEP 0.505964
struct KeyLobe {
    vec4 direction;  // xyz: unit, toward the light; w: concentration
    vec4 flux;       // xyz: linear Rec.709 radiance * sr; w: their largest
    vec4 moments;    // mean of the cosine; variance along the direction less that across it, over that mean's square;
                     // variance across it; 5.2 deviations across it
    vec4 turns;      // cosine and sine of a deviation of psi, 1/sqrt(concentration); of the step between two windows
    vec4 mean;       // xyz: of the directions; w: 5.2 deviations across
    vec4 variance;   // xy: 12 times that of u = s_g + v_g: factor of the mean s_g, squared; constant. zw: cosine and
                     // sine of the angle from the middle to the last window
    vec4 height;     // by how much the mean of max(0, s_n) exceeds max(0, m), m being the mean of s_n, times the
                     // largest flux: log2 as a cubic in |m|
};
ROWLAND_BLOCK(6, KeyLobeBlock) {
    vec4 key_lobe_count;  // x
    KeyLobe key_lobes[ROWLAND_MAXIMUM_KEY_LOBES];
};
#ifdef SMALL_LIGHTS
ROWLAND_BLOCK(7, LightColourBlock) {
    vec4 light_layer_scale[ROWLAND_MAXIMUM_LIGHTS];  // of lights[]. x: the layer of the kernel table that holds the
                                                     // light's colour; y: the light's strength over that colour
};
#endif
#ifdef __cplusplus
static_assert(sizeof(KeyLobeBlock) == 16 + std::size_t{112} * ROWLAND_MAXIMUM_KEY_LOBES &&
                  sizeof(LightColourBlock) == std::size_t{16} * ROWLAND_MAXIMUM_LIGHTS,
              "must equal the std140 layout");
}  // namespace rowland::diffraction
#undef ROWLAND_BLOCK
#undef SMALL_LIGHTS
#endif

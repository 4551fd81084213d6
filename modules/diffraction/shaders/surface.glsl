// Common to the fragment stages of all gratings. Programs that shade vertices define VERTEX_SHADED. A file is included
// once, at its first #include, so that conditions are inside the files.
#define MATERIAL_HAS_MIRROR
#include "engine/render/shaders/forward_fragment_interface.glsl"
#include "modules/diffraction/shaders/has_direct.glsl"
#include "engine/render/shaders/light_block.h"
#include "modules/diffraction/shaders/groove_view.glsl"
#include "modules/diffraction/shaders/direct.glsl"

// Weights of the engine's shading, working space.
uniform vec3 mirror_weight;
uniform vec3 base_weight;

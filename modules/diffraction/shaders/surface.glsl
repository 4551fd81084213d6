// What the fragment stages of all gratings share. Programs whose vertices are shaded define VERTEX_SHADED. A file is
// pasted once, where it is first included: what is conditional is so inside the files.
#define MATERIAL_HAS_MIRROR
#include "engine/render/shaders/forward_fragment_interface.glsl"
#include "modules/diffraction/shaders/has_direct.glsl"
#include "engine/render/shaders/light_block.h"
#include "modules/diffraction/shaders/groove_view.glsl"
#include "modules/diffraction/shaders/direct.glsl"

// What the grating leaves to the engine, working space.
uniform vec3 mirror_weight;
uniform vec3 base_weight;

// What a material's fragment stage sees before it defines
//   MaterialTerms material_terms();
#include "engine/render/shaders/frame_block.h"
#include "engine/render/shaders/object_block.h"

in vec3 world_position;
in vec3 world_normal;

#ifdef NORMAL_MAP
in vec4 world_tangent;
#endif
#ifdef HAS_UV
in vec2 uv;
#endif
#ifdef HAS_UV1
in vec2 uv1;
#endif
#ifdef HAS_COLOURS
in vec4 colour;
#endif

// What a material adds to, and leaves of, the engine's metallic-roughness surface. Working space.
struct MaterialTerms {
    vec3 base_weight;    // share of the light that reaches the metallic-roughness base
    vec3 mirror_weight;  // share reflected as by a mirror: the zero order of a grating
    vec3 added;          // radiance of the material's own
};

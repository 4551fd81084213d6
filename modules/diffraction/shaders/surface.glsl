// Common to the fragment stages of all gratings. Programs that shade vertices define VERTEX_SHADED. A file is included
// once, at its first #include, so that conditions are inside the files.
#if defined(TRANSMISSION) || defined(REFLECTED_SIDE)
#define MATERIAL_PASSES_LIGHT
#endif
#ifndef TRANSMISSION
#define MATERIAL_HAS_MIRROR
#endif
#ifdef COVER
#define MATERIAL_GLOSS
#endif
#include "engine/render/shaders/forward_fragment_interface.glsl"
#include "modules/diffraction/shaders/cover.glsl"
#include "modules/diffraction/shaders/has_direct.glsl"
#include "engine/render/shaders/light_block.h"
#include "modules/diffraction/shaders/groove_view.glsl"
#include "modules/diffraction/shaders/direct.glsl"

// Weights of the engine's shading, working space.
uniform vec3 mirror_weight;  // of order 0
uniform vec3 base_weight;

#ifdef COVER
float gloss_reflectance(float cosine) { return 1.0 - cover_transmittance(cosine); }
float gloss_roughness() { return 0.1; }
#endif

#if defined(TRANSMISSION)
vec3 background_weight() { return mirror_weight; }
#elif defined(REFLECTED_SIDE)
vec3 background_weight() { return vec3(1.0); }  // over the transmitted side
#endif

// A surface that diffracts `radiance`. A cover dims all that lies under it, and reflects the rest like a mirror, on the
// side that is seen. It is passed twice by light that order 0 mirrors.
MaterialTerms surface_terms(vec3 radiance) {
#ifdef COVER
    float passed = cover_transmittance(abs(dot(normalize(world_normal), normalize(eye.xyz - world_position))));
    return MaterialTerms(passed * base_weight, vec3(1.0 - passed) + passed * passed * mirror_weight, passed * radiance);
#else
    return MaterialTerms(base_weight, mirror_weight, radiance);
#endif
}

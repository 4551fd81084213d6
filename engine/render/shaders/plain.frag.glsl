#version 450 core
#ifdef CLEAR_COAT
#define MATERIAL_GLOSS
#endif
#include "engine/render/shaders/forward_fragment_interface.glsl"

#ifdef CLEAR_COAT
// KHR_materials_clearcoat: a dielectric layer of index 1.5 over the base, which it dims by what it reflects.
float gloss_reflectance(float cosine) { return metallic_roughness.w * schlick_reflectance(vec3(0.04), cosine).x; }
float gloss_roughness() { return emissive.w; }

// The engine's.
vec3 surface_normal();
vec2 lobe_albedo(float n_v, float roughness);
vec3 lobe_direction(vec3 n, vec3 v, float roughness);
vec3 environment_light(vec3 direction, float roughness);

MaterialTerms material_terms() {
    vec3 v = normalize(eye.xyz - world_position);
    vec3 n = surface_normal();
    vec2 albedo = lobe_albedo(max(dot(n, v), 0.0), gloss_roughness());
    float reflected = metallic_roughness.w * (0.04 * albedo.x + albedo.y);
    vec3 light = environment_light(lobe_direction(n, v, gloss_roughness()), gloss_roughness());
    return MaterialTerms(vec3(1.0 - reflected), vec3(0.0), reflected * light);
}
#else
MaterialTerms material_terms() { return MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0)); }
#endif

#include "engine/render/shaders/forward_fragment_main.glsl"

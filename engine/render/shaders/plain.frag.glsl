#version 450 core
// The metallic-roughness surface, with or without a clear coat.
#ifdef CLEAR_COAT
#define MATERIAL_GLOSS
#endif
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"

#ifdef CLEAR_COAT
// KHR_materials_clearcoat: a dielectric layer of index 1.5 over the base, which it dims by what it reflects.
float gloss_reflectance(float cosine) { return metallic_roughness.w * schlick_reflectance(vec3(0.04), cosine).x; }
float gloss_roughness() { return emissive.w; }
#endif

#include "engine/render/shaders/shading.glsl"

void main() {
    read_screen_visibility();
    MaterialTerms terms = MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0));
#ifdef CLEAR_COAT
    vec3 v = to_eye();
    vec3 normal = surface_normal();
    vec2 albedo = lobe_albedo(max(dot(normal, v), 0.0), gloss_roughness());
    float reflected = metallic_roughness.w * (0.04 * albedo.x + albedo.y);
    terms.base_weight = vec3(1.0 - reflected);
    vec3 light = environment_light(lobe_direction(normal, v, gloss_roughness()), gloss_roughness());
    terms.added = reflected * light;
#endif
    write_surface(terms);
}

#version 450 core
// The metallic-roughness surface, with or without a clear coat.
#ifdef CLEAR_COAT
#define MATERIAL_COAT
#endif
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"

#ifdef CLEAR_COAT
// KHR_materials_clearcoat: a dielectric layer of index 1.5, which attenuates the base by 1 - its reflectance.
float coat_strength() { return metallic_roughness.w; }
float coat_reflectance(float cosine) { return coat_strength() * schlick_reflectance(vec3(0.04), cosine).x; }
float coat_roughness() { return emissive.w; }
#endif

#include "engine/render/shaders/shading.glsl"

void main() {
    read_screen_visibility();
    MaterialTerms terms = MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0));
#ifdef CLEAR_COAT
    vec3 v = to_eye();
    vec3 normal = surface_normal();
    vec2 dfg = split_sum_dfg(max(dot(normal, v), 0.0), coat_roughness());
    float reflected = coat_strength() * (0.04 * dfg.x + dfg.y);
    terms.base_weight = vec3(1.0 - reflected);
    vec3 light = environment_light(lobe_direction(normal, v, coat_roughness()), coat_roughness());
    terms.added = reflected * light;
#endif
    write_surface(terms);
}

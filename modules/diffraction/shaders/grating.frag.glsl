#version 450 core
// A grating at a pixel: its surface and grooves, the light from the probe, analytic lights by the colour kernel, the layer
// under the grooves. README.md lists the defines.
#if defined(TRANSMISSION) || defined(REFLECTED_SIDE)
#define MATERIAL_PASSES_LIGHT
#endif
#ifndef TRANSMISSION
#define MATERIAL_HAS_MIRROR
#endif
#ifdef COVER
#define MATERIAL_COAT
#endif
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"
#include "modules/diffraction/shaders/grooves.glsl"

// ---- The light from the probe
#ifdef VERTEX_SHADED
in vec3 diffracted;  // working space; with the lights that the vertices shade
#endif
#include PROBE_LIGHT
// The representation's vec3 diffracted_radiance(GrooveView view): working space, of a view above the horizon.

// ---- Analytic lights: the sum of 1/2 s_n d k(d u) F * 2 D_h, the kernel smoothed over the light and the pixel (PHYSICS §4)
#include "modules/diffraction/shaders/light_blocks.h"
#include "modules/diffraction/shaders/kernel.glsl"
#include KEY_LOBES
#include LATTICE

#ifdef LIGHTS_FROM_VERTICES
in vec3 lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
in vec3 shadowed_at_vertex;
#endif

// What one part of the pixel diffracts of the probe: as a whole, and its key lights one by one.
vec3 probe_radiance(GrooveView view) {
    vec3 sum = vec3(0.0);
#ifdef PROBE_LIGHT
    sum += diffracted_radiance(view);
#endif
#if defined(KEY_LOBES) && !defined(LIGHTS_AT_VERTICES)
    sum += key_lights_at_pixel(view);
#endif
    return sum;
}

// The scene's lights: shading.glsl calls material_light() for each. Directional ones may be part of the probe.
#ifdef PUNCTUAL_LIGHTS
#define MATERIAL_PUNCTUAL_LIGHTS
#endif
#if defined(DIRECTIONAL_LIGHTS) && defined(SEPARATE_LIGHTS) && !defined(LIGHTS_AT_VERTICES)
#define MATERIAL_DIRECTIONAL_LIGHTS
#endif
#if defined(MATERIAL_PUNCTUAL_LIGHTS) || defined(MATERIAL_DIRECTIONAL_LIGHTS)
GrooveView lit_view;
float lit_weight;  // of all lights
#ifndef LATTICE
KernelScale lit_scale;
#endif

void prepare_lights(GrooveView view) {
    lit_view = view;
    // The engine's normal, whose cosine to each light is then computed once; the same where the view is above the horizon.
    lit_view.axes[2] = LIT_SIDE * seen_normal(LIT_SIDE * view.axes[2], to_eye());
#ifdef LATTICE
    lit_weight = view.direction.z > 0.0 ? cover_transmittance(view.direction.z) : 0.0;
#else
    lit_scale = kernel_scale();
    lit_weight = small_light_weight(lit_scale, view.direction.z) * cover_transmittance(view.direction.z);
#endif
}

void material_light(int i, float attenuation, vec3 l, float variance, inout vec3 added) {
    float weight = lit_weight * attenuation;
    vec3 sum = vec3(0.0);  // XYZ with pits, else working space
#if defined(LATTICE)
    add_pattern_light(i, weight, l, variance, lit_view, sum);
#elif defined(GROOVE_MAP)
    MeshU mesh = mesh_u_of(lit_view, l);
    int parts = groove_parts(lit_view);
    for (int part = 0; part < parts; ++part) {
        GrooveView one = groove_part(lit_view, parts, part);
        if (one.pitch > 0.0)
            add_small_light(lit_scale, i, one.coverage * weight, l, variance, one.axes, one.direction.y,
                            turned_pixel_u(one, mesh), one.pitch, sum);
    }
    sum /= float(parts);
#else
    add_small_light(lit_scale, i, weight, l, variance, lit_view.axes, lit_view.direction.y, pixel_u_of(lit_view, l),
                    lit_view.pitch, sum);
#endif
    added += kernel_to_working(sum);
}
#else
void prepare_lights(GrooveView view) {}
#endif

// ---- The layer under the grooves and the cover over them
uniform vec3 mirror_weight;  // of order 0; working space
uniform vec3 base_weight;
#if defined(WEAR_MAP) && !defined(TRANSMISSION)
#define MATERIAL_REFLECTANCE
uniform vec3 reflectance;  // of all orders
vec3 material_reflectance() { return reflectance; }
#endif

#ifdef COVER  // the coat is the cover's gloss
float coat_reflectance(float cosine) { return 1.0 - cover_transmittance(cosine); }
float coat_roughness() { return 0.1; }
#endif

#if defined(TRANSMISSION)
vec3 background_weight() { return mirror_weight; }
#elif defined(REFLECTED_SIDE)
vec3 background_weight() { return vec3(1.0); }  // over the transmitted side
#endif

#include "engine/render/shaders/shading.glsl"

// A cover dims all that lies under it, and reflects the rest like a mirror, on the side that is seen. Light that order
// 0 mirrors passes it twice. `coverage`: the fraction of the pixel that has a grating; the layer has the rest for
// itself.
MaterialTerms layer_terms(vec3 diffracted_sum, float coverage) {
    vec3 base = mix(vec3(1.0), base_weight, coverage);
    vec3 mirror = coverage * mirror_weight;
#ifdef COVER
    float passed = cover_transmittance(abs(dot(normalize(world_normal), to_eye())));
    return MaterialTerms(passed * base, vec3(1.0 - passed) + passed * passed * mirror, passed * diffracted_sum);
#else
    return MaterialTerms(base, mirror, diffracted_sum);
#endif
}

void main() {
    read_screen_visibility();
    vec3 sum = vec3(0.0);
    float coverage = 1.0;
#ifdef VERTEX_SHADED
    sum = diffracted;
#if !defined(DIRECTIONAL_LIGHTS) || (defined(SHADOWED_AT_PIXELS) && !defined(SEVERAL_DIRECTIONAL_LIGHTS))
    sum *= ambient_visibility();  // the vertices have added only the probe
#endif
#endif
#ifdef LIGHTS_FROM_VERTICES
    sum += lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
    sum += shadow_visibility(lights[0].position.xyz) * shadowed_at_vertex;
#endif
#if !defined(VERTEX_SHADED) || defined(LIGHTS_AT_PIXELS)
    GrooveView view = groove_view();
#ifdef GROOVE_GAPS
    coverage = view.coverage;
#endif
    if (view.direction.z > 0.0 && view.pitch > 0.0) {
#ifdef GROOVE_MAP
        int parts = groove_parts(view);
        vec3 from_parts = vec3(0.0);
        for (int part = 0; part < parts; ++part) {
            GrooveView one = groove_part(view, parts, part);
            if (one.pitch > 0.0) from_parts += one.coverage * probe_radiance(one);
        }
        sum += ambient_visibility() * from_parts / float(parts);
#else
        sum += ambient_visibility() * probe_radiance(view);
#endif
    }
    prepare_lights(view);
#endif
    write_surface(layer_terms(sum, coverage));
}

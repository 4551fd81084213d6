// Analytic lights, shaded by the colour kernel (PHYSICS §4): the sum of 1/2 s_n d k(d u) F * 2 D_h, the kernel smoothed
// over the light and the pixel.
#include "modules/diffraction/shaders/small_light.glsl"
#include "modules/diffraction/shaders/key_lobes.glsl"
#include "modules/diffraction/shaders/key_lobe_windows.glsl"
#include "modules/diffraction/shaders/pattern.glsl"

#ifdef LIGHTS_BESIDE
in vec3 lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
in vec3 shadowed_at_vertex;
float shadow_visibility(vec3 l);  // the engine's
#endif

// The lights that the vertices shade. Working space, as all below.
vec3 lights_from_vertices() {
    vec3 sum = vec3(0.0);
#ifdef LIGHTS_BESIDE
    sum += lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
    sum += shadow_visibility(lights[0].position.xyz) * shadowed_at_vertex;
#endif
    return sum;
}

#if defined(KEY_LOBES) && !defined(LIGHTS_AT_VERTICES)
vec3 key_lights_at_pixel(GrooveView view) {
#if defined(LATTICE)
    return pattern_key_lights(view);
#elif defined(KEY_LOBE_TABLE)
    return kernel_to_working(key_lights_radiance(view.axes, view.direction, view.g_change, view.v_g_change));
#else
    return kernel_to_working(key_lights_radiance(view));
#endif
}
#elif !defined(VERTEX_SHADED) || defined(LIGHTS_AT_PIXELS)
vec3 key_lights_at_pixel(GrooveView view) { return vec3(0.0); }
#endif

// The scene's lights, which the engine's loop over them calls for.
#ifdef PUNCTUAL_LIGHTS
#define MATERIAL_PUNCTUAL_LIGHTS
#endif
#if defined(DIRECTIONAL_LIGHTS) && defined(SEPARATE_LIGHTS) && !defined(LIGHTS_AT_VERTICES)
#define MATERIAL_DIRECTIONAL_LIGHTS
#endif
#if defined(MATERIAL_PUNCTUAL_LIGHTS) || defined(MATERIAL_DIRECTIONAL_LIGHTS)
GrooveView lit_view;
#ifndef LATTICE
KernelScale lit_scale;
#endif
float lit_weight;  // of all lights

void prepare_lights(GrooveView view) {
    lit_view = view;
    // The engine's normal, whose cosine to each light is then computed once; the same where the view is above the horizon.
    lit_view.axes[2] = LIT_SIDE * seen_normal(LIT_SIDE * view.axes[2], normalize(eye.xyz - world_position));
#ifdef LATTICE
    lit_weight = view.direction.z > 0.0 ? cover_transmittance(view.direction.z) : 0.0;
#else
    lit_scale = kernel_scale();
    lit_weight = small_light_weight(lit_scale, view.direction.z) * cover_transmittance(view.direction.z);
#endif
}

#ifndef LATTICE
// XYZ with pits, else working space.
void add_light_of(GrooveView view, PixelU u, int i, float weight, vec3 l, inout vec3 sum) {
    add_small_light(lit_scale, i, weight, l, view.axes, view.direction.y, u, view.pitch, sum);
}
#endif

void material_light(int i, float attenuation, vec3 l, inout vec3 added) {
    vec3 sum = vec3(0.0);
    float weight = lit_weight * attenuation;
#if defined(LATTICE)
    add_pattern_light(i, weight, l, lit_view, sum);
#elif defined(GROOVE_MAP)
    MeshU mesh = mesh_u_of(lit_view, l);
    int parts = groove_parts(lit_view);
    for (int part = 0; part < parts; ++part) {
        GrooveView one = groove_part(lit_view, parts, part);
        if (one.pitch > 0.0)
            add_light_of(one, turned_pixel_u(one, mesh), i, one.coverage * weight, l, sum);
    }
    sum /= float(parts);
#else
    add_light_of(lit_view, pixel_u_of(lit_view, l), i, weight, l, sum);
#endif
    added += kernel_to_working(sum);
}
#elif !defined(VERTEX_SHADED) || defined(LIGHTS_AT_PIXELS)
void prepare_lights(GrooveView view) {}
#endif

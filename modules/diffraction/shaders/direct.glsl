// Analytic lights, shaded by the colour kernel (PHYSICS §4): the sum of 1/2 s_n d k(d u) F * 2 D_h, the kernel smoothed
// over the light and the pixel.
#include "modules/diffraction/shaders/small_light.glsl"
#include "modules/diffraction/shaders/key_lobes.glsl"
#include "modules/diffraction/shaders/key_lobe_parts.glsl"

#ifdef LIGHTS_BESIDE
in vec3 lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
in vec3 shadowed_at_vertex;
#endif
#ifdef PUNCTUAL_LIGHTS
float punctual_attenuation(Light light, float distance2, vec3 l);  // the engine's
#endif
#ifdef SHADOWS
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

#ifdef LIGHTS_AT_PIXELS
vec3 direct_radiance(GrooveView view) {
    vec3 sum = vec3(0.0);
#ifdef SMALL_LIGHTS
    KernelRow row = kernel_row(view.pitch * 0.57735026918963 * view.footprint);
#endif
#ifndef LIGHTS_AT_VERTICES
#if defined(KEY_LOBE_TABLE)
    sum += key_lights_radiance(view.axes, view.direction, view.footprint);
#elif defined(KEY_LOBES)
    sum += key_lights_radiance(view);
#endif
#if defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)
#ifdef SEVERAL_DIRECTIONAL_LIGHTS
    int directional = int(light_counts.x);
#else
    const int directional = 1;
#endif
    for (int i = 0; i < directional; ++i) {
        float visibility = 1.0;
#ifdef SHADOWS
        if (i == 0) visibility = shadow_visibility(lights[i].position.xyz);
#endif
        sum += small_light_radiance(i, visibility, lights[i].position.xyz, view.axes, view.direction, row, view.pitch);
    }
#endif
#endif
#ifdef PUNCTUAL_LIGHTS
    for (int i = int(light_counts.x); i < int(light_counts.y); ++i) {
        vec3 to_light = lights[i].position.xyz - world_position;
        float distance2 = dot(to_light, to_light);
        vec3 l = to_light * inversesqrt(max(distance2, 1e-12));
        sum += small_light_radiance(i, punctual_attenuation(lights[i], distance2, l), l, view.axes, view.direction, row,
                               view.pitch);
    }
#endif
    return kernel_to_working(sum);
}
#elif !defined(VERTEX_SHADED)
vec3 direct_radiance(GrooveView view) { return vec3(0.0); }
#endif

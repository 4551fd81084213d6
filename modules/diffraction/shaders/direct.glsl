// Lights of their own, shaded by the colour kernel (PHYSICS, "direct"): XYZ = sum of 1/2 s_n d k(d u) F * 2 D_h, the
// kernel smoothed over the light and the pixel. Points and spots always; under SEPARATE_LIGHTS the probe's key lights and
// directional lights, too.
#ifdef HAS_DIRECT
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"

float footprint_deviation(GrooveView view) { return 0.57735026918963 * view.footprint; }

#ifdef SEPARATE_LIGHTS
#include "modules/diffraction/shaders/light_spot.glsl"

vec3 key_lobe_xyz(KeyLobe lobe, GrooveView view) {
    vec3 axis = lobe.direction.xyz * view.axes;
    // 5e-8 of a lobe's cosine is left five deviations below the horizon.
    if (axis.z * lobe.moments.x < -5.0 * sqrt(lobe.moments.z + lobe.moments.y)) return vec3(0.0);
#ifndef ZERO_ORDER
    // The parts lie within 2.3 deviations of the lobe's direction, and each reaches 5 times 0.84 of one.
    float reach = 6.5 * sqrt(lobe.moments.z) + 5.0 * (footprint_deviation(view) + kernel_place.z);
    if (!kernel_reached(axis.x + view.direction.x, reach)) return vec3(0.0);
#endif
    axis.x = clamp(axis.x, -1.0, 1.0);
    float across = max(length(axis.yz), 1e-6);
    vec3 xyz = vec3(0.0);
    float whole = 0.0;
    for (int i = 0; i < 3; ++i) {
        float weight;
        LightPart part = lobe_part(lobe, axis, across, i, weight);
        whole += weight;
        if (part.cosine <= 0.0) continue;
        float deviation = length(vec2(part.deviation, footprint_deviation(view)));
        xyz += part.cosine * kernel_xyz(part.centre + view.direction.x, deviation, lobe.flux.rgb);
    }
    vec2 along = spread_along_grooves(lobe, axis);
    return 0.5 / max(whole, 1e-6) * groove_factor(along.x + view.direction.y, along.y) * xyz;
}
#endif

#if (defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)) || defined(PUNCTUAL_LIGHTS)
uniform mat3 working_to_rec709;

// `irradiance` on a surface that faces the light, working space.
vec3 small_light_xyz(vec3 l, vec3 irradiance, GrooveView view) {
    vec3 s = l * view.axes;
    if (s.z <= 0.0) return vec3(0.0);
    vec3 flux = working_to_rec709 * irradiance;
    return 0.5 * s.z * groove_factor(s.y + view.direction.y, 0.0) *
           kernel_xyz(s.x + view.direction.x, footprint_deviation(view), flux);
}
#endif

#ifdef PUNCTUAL_LIGHTS
vec3 punctual_irradiance(Light light, float distance2, vec3 l);  // the engine's
#endif
#ifdef SHADOWS
float shadow_share(vec3 l);  // the engine's
#endif

vec3 direct_xyz(GrooveView view) {
    vec3 xyz = vec3(0.0);
#ifdef SEPARATE_LIGHTS
    for (int i = 0; i < int(key_lobe_count.x); ++i) xyz += key_lobe_xyz(key_lobes[i], view);
#ifdef DIRECTIONAL_LIGHTS
#ifdef SEVERAL_DIRECTIONAL_LIGHTS
    int directional = int(light_counts.x);
#else
    const int directional = 1;
#endif
    for (int i = 0; i < directional; ++i) {
        vec3 irradiance = lights[i].strength.rgb;
#ifdef SHADOWS
        if (i == 0) irradiance *= shadow_share(lights[i].place.xyz);
#endif
        xyz += small_light_xyz(lights[i].place.xyz, irradiance, view);
    }
#endif
#endif
#ifdef PUNCTUAL_LIGHTS
    for (int i = int(light_counts.x); i < int(light_counts.y); ++i) {
        vec3 to_light = lights[i].place.xyz - world_position;
        float distance2 = dot(to_light, to_light);
        vec3 l = to_light * inversesqrt(max(distance2, 1e-12));
        xyz += small_light_xyz(l, punctual_irradiance(lights[i], distance2, l), view);
    }
#endif
    return xyz;
}

#endif

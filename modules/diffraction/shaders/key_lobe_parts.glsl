// The probe's key lights on a grating part by part, without tables.
#include "modules/diffraction/shaders/light_spot.glsl"
#include "modules/diffraction/shaders/small_light.glsl"
#if defined(KEY_LOBES) && !defined(KEY_LOBE_TABLE) && !defined(KEY_LOBE_WINDOWS)

vec3 key_lobe_radiance(KeyLobe lobe, GrooveView view) {
    PixelU u = pixel_u(view, lobe.direction.xyz);
    vec3 axis = to_tangent(view, lobe.direction.xyz);
    vec3 mean = lobe.moments.x * axis;
    // Five deviations below the horizon, 5e-8 of the lobe's cosine remains.
    if (mean.z < -lobe.moments.w) return vec3(0.0);
#ifndef ZERO_ORDER
    // The parts lie within 2.3 deviations of the lobe's direction, and each reaches 5 times 0.84 of one.
    float reach = view.pitch * (6.5 * sqrt(lobe.moments.z) + 5.0 * deviation_of(u)) + 5.0 * kernel_scale_bias.z;
    if (!kernel_reached(view.pitch * u.mean, reach)) return vec3(0.0);
#endif
    axis.x = clamp(axis.x, -1.0, 1.0);
    float across = max(length(axis.yz), 1e-6);
    vec3 sum = vec3(0.0);
    float whole = 0.0;
    for (int i = 0; i < 3; ++i) {
        float weight;
        LightPart part = lobe_part(lobe, axis, across, i, weight);
        whole += weight;
        if (part.cosine <= 0.0) continue;
        float deviation = sqrt(part.deviation * part.deviation + BOX_VARIANCE * u.square_width);
        sum += part.cosine * pitch_kernel_value(u.mean + part.centre - axis.x, deviation, lobe.flux.rgb, view.pitch);
    }
    vec2 along = spread_along_grooves(mean, lobe.moments);
    return 0.5 / max(whole, 1e-6) * lobe_transmittance(mean.z, lobe.moments) *
           key_groove_factor(along.x + view.direction.y, along.y) * sum;
}

vec3 key_lights_radiance(GrooveView view) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) sum += key_lobe_radiance(key_lobes[i], view);
    return sum;
}

#endif

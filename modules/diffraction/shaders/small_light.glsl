// A light without extent on a grating.
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef HAS_DIRECT
#include "modules/diffraction/shaders/cover.glsl"
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#include "modules/diffraction/shaders/light_colour_block.h"

// d k(d u) for the pixel's own d = `pitch` times the material's.
vec3 pitch_kernel_value(float u, float deviation, vec3 rgb, float pitch) {
    return pitch * kernel_value(pitch * u, pitch * deviation, rgb);
}

#ifdef SMALL_LIGHTS
uniform mat3 working_to_rec709;

// Adds lights[i]. `attenuation`: irradiance on a surface that faces the light, over its strength; `axes`: columns g, h, n
// in the world; `direction`: toward the eye, in (g, h, n); `u`, `row`: the mean of s_g + v_g over the pixel, and the row
// of its deviation.
void add_small_light(int i, float attenuation, vec3 l, mat3 axes, vec3 direction, float u, KernelRow row, float pitch,
                     inout vec3 sum) {
    u *= pitch;
    float above = direction.z > 0.0 ? max(dot(l, axes[2]), 0.0) : 0.0;
    vec3 weight = 0.5 * pitch * attenuation * above * cover_transmittance(above) *
                  groove_factor(dot(l, axes[1]) + direction.y);
    // One look-up costs less than a branch around it.
    sum += weight * (light_colours[i].y * kernel_scale_bias.w) * kernel_texel(u, row, light_colours[i].x);
#ifdef ZERO_ORDER
    sum += weight * zero_order_value(u, row.wide, working_to_rec709 * lights[i].strength.rgb);
#endif
}
#endif
#endif

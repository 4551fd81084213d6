// A light without extent on a grating.
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef HAS_DIRECT
#include "modules/diffraction/shaders/cover.glsl"
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#include "modules/diffraction/shaders/light_colour_block.h"
#include "modules/diffraction/shaders/pixel_u.glsl"

// d k(d u) for the pixel's own d = `pitch` times the material's.
vec3 pitch_kernel_value(float u, float deviation, vec3 rgb, float pitch) {
    return pitch * kernel_value(pitch * u, pitch * deviation, rgb);
}

#ifdef SMALL_LIGHTS
uniform mat3 working_to_rec709;

// What lights are weighted by for a view of this cosine: 1/2 d of the kernel, 0 below the horizon.
float small_light_weight(KernelScale scale, float v_n) { return v_n > 0.0 ? 0.5 * scale.scale_bias.w : 0.0; }

// Adds lights[i]. `weight`: small_light_weight() times irradiance on a surface that faces the light, over its strength;
// `axes`: columns g, h, n in the world; `v_h`: toward the eye, along h; `u`: of s_g + v_g over the pixel.
void add_small_light(KernelScale scale, int i, float weight, vec3 l, mat3 axes, float v_h, PixelU u, float pitch,
                     inout vec3 sum) {
    float t = kernel_row(scale, pitch * pitch * u.square_width);
    float above = max(dot(l, axes[2]), 0.0);
    vec3 dimmed = (pitch * weight * above * cover_transmittance(above)) * groove_factor(dot(l, axes[1]) + v_h);
    // One look-up costs less than a branch around it.
    sum += dimmed * light_colours[i].y * kernel_texel(scale, pitch * u.mean, t, light_colours[i].x);
#ifdef ZERO_ORDER
    sum += dimmed / scale.scale_bias.w *
           zero_order_value(pitch * u.mean, pitch * deviation_of(u), working_to_rec709 * lights[i].strength.rgb);
#endif
}
#endif
#endif

// A light without extent on a grating.
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef HAS_DIRECT
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#include "modules/diffraction/shaders/light_colour_block.h"

// d k(d u) for the pixel's own d = `pitch` times the material's.
vec3 pitch_kernel_value(float u, float deviation, vec3 rgb, float pitch) {
    return pitch * kernel_value(pitch * u, pitch * deviation, rgb);
}

#ifdef SMALL_LIGHTS
uniform mat3 working_to_rec709;

// Of lights[i]. `attenuation`: irradiance on a surface that faces the light, over its strength; `axes`: columns g, h, n
// in the world; `direction`: toward the eye, in (g, h, n); `row`: of the pixel's footprint.
vec3 small_light_radiance(int i, float attenuation, vec3 l, mat3 axes, vec3 direction, KernelRow row, float pitch) {
    float weight = 0.5 * pitch * attenuation * max(dot(l, axes[2]), 0.0);
    float u = pitch * (dot(l, axes[0]) + direction.x);
    return weight * groove_factor(dot(l, axes[1]) + direction.y, 0.0) *
           coloured_kernel_value(u, row, light_colours[i].x, light_colours[i].y,
                                 working_to_rec709 * lights[i].strength.rgb);
}
#endif
#endif

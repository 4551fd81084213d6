// A light without extent on a grating.
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef HAS_DIRECT
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#include "modules/diffraction/shaders/light_colour_block.h"

// d k(d u) for the pixel's own d = `pitch` times the material's.
vec3 pitch_kernel_xyz(float u, float deviation, vec3 rgb, float pitch) {
    return pitch * kernel_xyz(pitch * u, pitch * deviation, rgb);
}

#ifdef SMALL_LIGHTS
uniform mat3 working_to_rec709;

// Of lights[i]. `attenuation`: irradiance on a surface that faces the light, over its strength; `axes`: columns g, h, n
// in the world; `direction`: toward the eye, in (g, h, n); `row`: of the pixel's footprint.
vec3 small_light_xyz(int i, float attenuation, vec3 l, mat3 axes, vec3 direction, KernelRow row, float pitch) {
    vec3 s = l * axes;
    vec3 weight = 0.5 * max(s.z, 0.0) * attenuation * groove_factor(s.y + direction.y, 0.0) * pitch;
    return weight * coloured_kernel_xyz(pitch * (s.x + direction.x), row, light_colours[i].x, light_colours[i].y,
                                        working_to_rec709 * lights[i].strength.rgb);
}
#endif
#endif

// A light without extent on a grating.
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef HAS_DIRECT
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"

// d k(d u) for the pixel's own d = `pitch` times the material's.
vec3 pitch_kernel_xyz(float u, float deviation, vec3 rgb, float pitch) {
    return pitch * kernel_xyz(pitch * u, pitch * deviation, rgb);
}

#if (defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)) || defined(PUNCTUAL_LIGHTS)
uniform mat3 working_to_rec709;

// `irradiance` on a surface that faces the light, working space; `axes`: columns g, h, n in the world; `direction`:
// toward the eye, in (g, h, n).
vec3 small_light_xyz(vec3 l, vec3 irradiance, mat3 axes, vec3 direction, float footprint_deviation, float pitch) {
    vec3 s = l * axes;
    if (s.z <= 0.0) return vec3(0.0);
    vec3 flux = working_to_rec709 * irradiance;
    return 0.5 * s.z * groove_factor(s.y + direction.y, 0.0) *
           pitch_kernel_xyz(s.x + direction.x, footprint_deviation, flux, pitch);
}
#endif
#endif

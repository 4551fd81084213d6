// Lights on a lattice: one look-up in its diffraction pattern for all orders, bake/pattern_picture.h and
// representations/direct/pattern_light.h.
#include "modules/diffraction/shaders/has_direct.glsl"
#if defined(LATTICE) && defined(HAS_DIRECT)
#include "modules/diffraction/shaders/cover.glsl"
#include "modules/diffraction/shaders/light_colour_block.h"

TEXTURE_UNIT(10) uniform sampler2DArray pattern_picture;  // layers as of the kernel's table
uniform vec4 pattern_scale;  // from u to the picture; bias of the level; scale of the values; reach of |u|

bool pattern_reaches(vec2 u) { return max(abs(u.x), abs(u.y)) < pattern_scale.w; }

vec3 pattern_texel(vec2 u, float level, float layer) {
    return textureLod(pattern_picture, vec3(u * pattern_scale.x + 0.5, layer), level).xyz;
}

// Of this variance of u.
float pattern_level(float variance) { return 0.5 * log2(max(variance, 1e-30)) + pattern_scale.y; }

// Of u over the pixel, from its differences to the pixels beside and below.
float pixel_variance(vec2 right, vec2 down) { return max(dot(right, right), dot(down, down)) / 12.0; }

#ifdef SMALL_LIGHTS
// Adds lights[i], as add_small_light(). Uses derivatives: call it in uniform control flow.
void add_pattern_light(int i, float weight, vec3 l, GrooveView view, inout vec3 sum) {
    vec2 u = vec2(dot(l, view.axes[0]), dot(l, view.axes[1])) + view.direction.xy;
    float level = pattern_level(pixel_variance(dFdx(u), dFdy(u)));
    float above = max(dot(l, view.axes[2]), 0.0);
    float flux = weight * above * cover_transmittance(above) * light_colours[i].y;
    if (!pattern_reaches(u)) flux = 0.0;
    sum += flux * pattern_scale.z * pattern_texel(u, level, light_colours[i].x);
}
#endif

#ifdef KEY_LOBES
#include "modules/diffraction/shaders/light_spot.glsl"
vec3 pattern_key_light(KeyLobe lobe, GrooveView view) {
    vec3 mean = lobe.mean.xyz * view.axes;
    vec2 u = mean.xy + view.direction.xy;
    if (!pattern_reaches(u)) return vec3(0.0);
    float variance = lobe.moments.z + 0.5 * lobe.moments.y * dot(mean.xy, mean.xy);
    vec2 right = vec2(dot(lobe.mean.xyz, view.g_change[0]), dot(lobe.mean.xyz, view.h_change[0])) +
                 vec2(view.v_g_change.x, view.v_h_change.x);
    vec2 down = vec2(dot(lobe.mean.xyz, view.g_change[1]), dot(lobe.mean.xyz, view.h_change[1])) +
                vec2(view.v_g_change.y, view.v_h_change.y);
    float level = pattern_level(variance + pixel_variance(right, down));
    vec3 value = vec3(0.0);
    for (int c = 0; c < 3; ++c) value += lobe.flux[c] * pattern_texel(u, level, float(c));
    float far = abs(mean.z);
    vec4 power = lobe.height;
    float height = max(mean.z, 0.0) +
                   exp2(power.x + far * (power.y + far * (power.z + far * power.w))) / lobe.flux.w;
    return height * lobe_transmittance(mean.z, lobe.moments) * value;
}

vec3 pattern_key_lights(GrooveView view) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) sum += pattern_key_light(key_lobes[i], view);
    return pattern_scale.z * sum;
}
#endif
#endif

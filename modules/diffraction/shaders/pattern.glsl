// Lights on a lattice: one look-up in its diffraction pattern for all orders, bake/diffraction_pattern.h and
// representations/direct/direct.h.

TEXTURE_UNIT(10) uniform sampler2DArray pattern_picture;  // a layer for each colour
uniform vec4 pattern_scale;  // from u to the picture; bias of the level; scale of the values; reach of |u|

const float FIRST_COLOUR_LAYER = 3.0;  // of the kernel's table, whose layers the lights name

bool pattern_reaches(vec2 u) { return max(abs(u.x), abs(u.y)) < pattern_scale.w; }

vec3 pattern_texel(vec2 u, float level, float layer) {
    return textureLod(pattern_picture, vec3(u * pattern_scale.x + 0.5, layer), level).xyz;
}

// The level for this variance of u.
float pattern_level(float variance) { return 0.5 * log2(max(variance, 1e-30)) + pattern_scale.y; }

// Variance of u over the pixel, from its differences to the pixels beside and below.
float pixel_variance(vec2 right, vec2 down) { return max(dot(right, right), dot(down, down)) / 12.0; }

#ifdef SMALL_LIGHTS
// Adds lights[i], as add_small_light(). Uses derivatives: call it in uniform control flow.
void add_pattern_light(int i, float weight, vec3 l, float variance, GrooveView view, inout vec3 sum) {
    vec2 centre = vec2(dot(l, view.axes[0]), dot(l, view.axes[1]));
    vec2 u = centre - 2.0 * variance * centre + view.direction.xy;
    float above = max(dot(l, view.axes[2]), 0.0);
    // In the plane a disc is narrower toward the light than across: the mean of both.
    float in_plane = 0.5 * variance * (1.0 + above * above);
    float level = pattern_level(in_plane + pixel_variance(dFdx(u), dFdy(u)));
    float flux = weight * above * cover_transmittance(above) * light_layer_scale[i].y;
    if (!pattern_reaches(u)) flux = 0.0;
    sum += flux * pattern_scale.z * pattern_texel(u, level, light_layer_scale[i].x - FIRST_COLOUR_LAYER);
}
#endif

#ifdef KEY_LOBES
TEXTURE_UNIT(14) uniform sampler2DArray pattern_lobes;  // a layer for each light
uniform vec4 pattern_lobe_scale;  // from u to the picture; variance of a texel; scale of the values, per unit of the
                                  // largest flux; reach of |u|
const float PICTURE_VARIANCE = 0.5;   // direct/direct.h, kPictureVariance

vec3 pattern_lobe_texel(vec2 u, float level, int light) {
    return textureLod(pattern_lobes, vec3(u * pattern_lobe_scale.x + 0.5, light), level).xyz;
}

// direct/direct.h, pattern_radiance(), per unit of the scale.
vec3 pattern_key_light(int i, KeyLobe lobe, GrooveView view) {
    vec3 mean = lobe.mean.xyz * view.axes;
    vec2 u = mean.xy + view.direction.xy;
    if (max(abs(u.x), abs(u.y)) > pattern_lobe_scale.w) return vec3(0.0);
    vec2 right = vec2(dot(lobe.mean.xyz, view.g_change[0]), dot(lobe.mean.xyz, view.h_change[0])) +
                 vec2(view.v_g_change.x, view.v_h_change.x);
    vec2 down = vec2(dot(lobe.mean.xyz, view.g_change[1]), dot(lobe.mean.xyz, view.h_change[1])) +
                vec2(view.v_g_change.y, view.v_h_change.y);
    // In the plane the lobe is narrower toward the light than across.
    float steepness = dot(mean.xy, mean.xy);
    float across = lobe.moments.z + pixel_variance(right, down);
    float narrowest = max(PICTURE_VARIANCE * lobe.moments.z, pattern_lobe_scale.y);
    float shown = max(across + lobe.moments.y * steepness, narrowest);
    float wider = 1.0 + (shown - narrowest) / max(narrowest / 3.0, pattern_lobe_scale.y);
    float finer = floor(0.5 * log2(wider));
    float level = finer + (wider * exp2(-2.0 * finer) - 1.0) / 3.0;
    vec2 tap = vec2(-mean.y, mean.x) * sqrt(3.0 * max(across - shown, 0.0) / max(steepness, 1e-12));
    vec3 value = 4.0 * pattern_lobe_texel(u, level, i) + pattern_lobe_texel(u + tap, level, i) +
                 pattern_lobe_texel(u - tap, level, i);
    float far = abs(mean.z);
    vec4 power = lobe.height;
    float flux = lobe.flux.w * max(mean.z, 0.0) +
                 exp2(power.x + far * (power.y + far * (power.z + far * power.w)));
    return flux / 6.0 * lobe_transmittance(mean.z, lobe.moments) * value;
}

// Working space.
vec3 key_lights_at_pixel(GrooveView view) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) sum += pattern_key_light(i, key_lobes[i], view);
    return pattern_lobe_scale.z * sum;
}
#endif

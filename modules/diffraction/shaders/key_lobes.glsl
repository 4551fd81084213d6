// The probe's key lights on a grating in one look-up each: representations/direct/lobe_table.h.
#include "modules/diffraction/shaders/light_spot.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#ifdef KEY_LOBE_TABLE

layout(binding = 14) uniform sampler2DArray lobe_table;  // a layer for each light
uniform vec3 lobe_scale_bias;  // scale and offset from u to s; scale of the values, per unit of the largest flux
uniform vec2 lobe_reach;       // the kernel is 0 where |u| differs from x by more than y

// `axes`: columns g, h, n in the world; `direction`: toward the eye, in (g, h, n); `footprint`: half an extent in v_g.
vec3 key_lobe_radiance(int light, mat3 axes, vec3 direction, float footprint) {
    vec4 toward = key_lobes[light].direction;
    vec4 moments = key_lobes[light].moments;
    float s_g = dot(toward.xyz, axes[0]);
    float u = s_g + direction.x;
    // Most lights miss the orders. A table's values reach 5.2 deviations: light_spot.glsl, lobe_part().
    if (abs(abs(u) - lobe_reach.x) > lobe_reach.y + moments.w + 1.2 * footprint) return vec3(0.0);
    float s_n = dot(toward.xyz, axes[2]);
    float height = clamped_mean(moments.x * s_n, sqrt(max(moments.y * s_n * s_n + moments.z, 0.0)));
    float across2 = max(1.0 - s_g * s_g, 1e-9);
    vec2 uv = vec2(u * lobe_scale_bias.x + lobe_scale_bias.y, 0.5 + 0.5 * s_g / (abs(s_g) + sqrt(across2)));
    // Samples over the footprint with its variance, no farther apart than the width of the lobe: lobe_radiance().
    float widths2 = footprint * footprint / (moments.z * across2);
    int taps = widths2 > 0.00390625 ? clamp(int(ceil(sqrt(widths2))), 2, 16) : 1;
    float aside = taps > 1 ? footprint * lobe_scale_bias.x * inversesqrt(1.0 - 1.0 / float(taps * taps)) : 0.0;
    vec3 value = vec3(0.0);
    int i = 0;
    do {  // a loop with its condition first takes a sample more on processors
        float s = uv.x + aside * (float(2 * i + 1) / float(taps) - 1.0);
        value += textureLod(lobe_table, vec3(s, uv.y, light), 0.0).xyz;
    } while (++i < taps);
    vec2 along = spread_along_grooves(toward.xyz * axes, moments);
    return lobe_scale_bias.z * key_lobes[light].flux.w / float(taps) * height *
           key_groove_factor(along.x + direction.y, along.y) * value;
}

vec3 key_lights_radiance(mat3 axes, vec3 direction, float footprint) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) sum += key_lobe_radiance(i, axes, direction, footprint);
    return sum;
}

#endif

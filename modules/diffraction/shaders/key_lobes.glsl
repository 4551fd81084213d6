// The probe's key lights on a grating in one look-up each: representations/direct/lobe_table.h.
#include "modules/diffraction/shaders/light_spot.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#ifdef KEY_LOBE_TABLE

layout(binding = 14) uniform sampler2DArray lobe_table;  // a layer for each light
uniform vec3 lobe_scale_bias;  // scale and offset from u to s; scale of the values, per unit of the largest flux
uniform vec2 lobe_reach;       // the kernel is 0 where |u| differs from x by more than y

// Adds a light. `axes`: columns g, h, n in the world; `direction`: toward the eye, in (g, h, n); `g_change`, `v_g_change`:
// differences to the next pixels; `widest`: the largest footprint of a light.
void add_key_lobe(int light, mat3 axes, vec3 direction, mat2x3 g_change, vec2 v_g_change, float widest,
                  inout vec3 sum) {
    vec3 toward = key_lobes[light].direction.xyz;
    vec4 moments = key_lobes[light].moments;
    float s_g = dot(toward, axes[0]);
    float u = s_g + direction.x;
    // Most lights miss the orders. A table's values reach 5.2 deviations: light_spot.glsl, lobe_part().
    if (abs(abs(u) - lobe_reach.x) < lobe_reach.y + moments.w + 1.2 * widest) {
        // Half the width of an interval of u that has its variance over the pixel: PHYSICS (38).
        float footprint = 0.5 * length(toward * g_change + v_g_change);
        float s_n = dot(toward, axes[2]);
        float height = clamped_mean(moments.x * s_n, sqrt(max(moments.y * s_n * s_n + moments.z, 0.0)));
        float across = sqrt(max(1.0 - s_g * s_g, 1e-9));
        vec2 uv = vec2(u * lobe_scale_bias.x + lobe_scale_bias.y, 0.5 + 0.5 * s_g / (abs(s_g) + across));
        // Samples over the footprint with its variance, no farther apart than the width of the lobe: lobe_radiance().
        float widths = 5.2 * footprint / (moments.w * across);
        float taps = widths > 0.0625 ? clamp(ceil(widths), 2.0, 16.0) : 1.0;
        float part = 1.0 / taps;
        float aside = taps > 1.0 ? footprint * lobe_scale_bias.x * inversesqrt(1.0 - part * part) : 0.0;
        vec3 value = vec3(0.0);
        float at = part - 1.0;
        do {  // a loop with its condition first takes a sample more on processors
            value += textureLod(lobe_table, vec3(uv.x + aside * at, uv.y, light), 0.0).xyz;
            at += 2.0 * part;
        } while (at < 1.0);
        vec2 along = spread_along_grooves(toward * axes, moments);
        sum += key_groove_factor(along.x + direction.y, along.y) *
               (lobe_scale_bias.z * key_lobes[light].flux.w * part * height * lobe_transmittance(s_n, moments)) * value;
    }
}

vec3 key_lights_radiance(mat3 axes, vec3 direction, mat2x3 g_change, vec2 v_g_change) {
    vec3 turned = abs(g_change[0]) + abs(g_change[1]);
    vec2 moved = abs(v_g_change);
    float widest = 0.5 * (turned.x + turned.y + turned.z + moved.x + moved.y);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i)
        add_key_lobe(i, axes, direction, g_change, v_g_change, widest, sum);
    return sum;
}

#endif

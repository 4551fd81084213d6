// The probe's key lights on a grating in one look-up each: representations/direct/lobe_table.h.

TEXTURE_UNIT(14) uniform sampler2DArray lobe_table;  // a layer for each light
uniform vec3 lobe_scale_bias;  // scale and offset from u to s; scale of the values, per unit of the largest flux
uniform vec2 lobe_reach;       // the kernel is 0 where |u| differs from x by more than y

// Position between the rows of the table, from 12 times the sum of u's variance and the least variance: LobeTable.
const float LOBE_ROW_SCALE = 1.0 / float(ROWLAND_LOBE_TABLE_OCTAVES);
const float LOBE_ROW_BIAS = LOBE_ROW_SCALE * (float(-ROWLAND_LOBE_TABLE_START) - 3.58496250072116);
float lobe_row(float variance, float s_g) {
    float row = log2(variance) * LOBE_ROW_SCALE + LOBE_ROW_BIAS;  // not negative
    uint side = floatBitsToUint(s_g) & 0x80000000u;
    return 0.5 + uintBitsToFloat(side | floatBitsToUint(row));
}

// Mean of s_n above 0, times the largest flux: direct/lobe_table.h, lobe_height_fit(). `mean_n`: of s_n.
float lobe_flux(int light, float mean_n) {
    vec4 power = key_lobes[light].height;
    float far = abs(mean_n);
    return key_lobes[light].flux.w * max(mean_n, 0.0) +
           exp2(power.x + far * (power.y + far * (power.z + far * power.w)));
}

// Adds a light. `axes`: columns g, h, n in the world; `direction`: toward the eye, in (g, h, n); `g_change`, `v_g_change`:
// differences to the next pixels; `beyond`: distance of |u| from lobe_reach.x from which on a light of one direction
// has values of 0.
void add_key_lobe(int light, mat3 axes, vec3 direction, mat2x3 g_change, vec2 v_g_change, float beyond,
                  inout vec3 sum) {
    vec3 mean = key_lobes[light].mean.xyz;
    float s_g = dot(mean, axes[0]);
    float u = s_g + direction.x;
    // Most lights miss the orders. Beyond five deviations a table holds next to nothing.
    if (abs(abs(u) - lobe_reach.x) - key_lobes[light].mean.w < beyond) {
        float mean_n = dot(mean, axes[2]);
        vec2 change = mean * g_change + v_g_change;
        vec2 powers = key_lobes[light].variance.xy;
        float variance = change.x * change.x + (change.y * change.y + (powers.x * s_g * s_g + powers.y));
        vec2 uv = vec2(u * lobe_scale_bias.x + lobe_scale_bias.y, lobe_row(variance, s_g));
        vec3 value = textureLod(lobe_table, vec3(uv, light), 0.0).xyz;
        vec4 moments = key_lobes[light].moments;
        vec2 along = spread_along_grooves(mean * axes, moments);
        sum += key_groove_factor(along.x + direction.y, along.y) *
               (lobe_flux(light, mean_n) * lobe_transmittance(mean_n, moments)) * value;
    }
}

vec3 key_lights_radiance(mat3 axes, vec3 direction, mat2x3 g_change, vec2 v_g_change) {
    vec3 turned = abs(g_change[0]) + abs(g_change[1]);
    vec2 moved = abs(v_g_change);
    // Five deviations of the widest footprint.
    float beyond = lobe_reach.y + 1.5 * (turned.x + turned.y + turned.z + moved.x + moved.y);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i)
        add_key_lobe(i, axes, direction, g_change, v_g_change, beyond, sum);
    return lobe_scale_bias.z * sum;
}

#ifndef VERTEX_STAGE
// Working space.
vec3 key_lights_at_pixel(GrooveView view) {
    return kernel_to_working(key_lights_radiance(view.axes, view.direction, view.g_change, view.v_g_change));
}
#endif

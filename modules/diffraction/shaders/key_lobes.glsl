// The probe's key lights on a grating in one look-up each: representations/direct/lobe_table.h.
#include "modules/diffraction/shaders/light_spot.glsl"
#include "modules/diffraction/shaders/groove_lobe.glsl"
#ifdef KEY_LOBE_TABLE

layout(binding = 14) uniform sampler2DArray lobe_table;  // a layer for each light
uniform vec3 lobe_scale_bias;  // scale and offset from u to s; scale of the values

// `axes`: columns g, h, n in the world; `direction`: toward the eye, in (g, h, n); `footprint`: half an extent in v_g.
vec3 key_lobe_xyz(int light, mat3 axes, vec3 direction, float footprint) {
    KeyLobe lobe = key_lobes[light];
    vec3 axis = lobe.direction.xyz * axes;
    float s_g = clamp(axis.x, -1.0, 1.0);
    float across2 = max(1.0 - s_g * s_g, 1e-9);
    float height = mean_above(clamp(axis.z * inversesqrt(across2), -1.0, 1.0), lobe.direction.w * across2);
    vec2 uv = vec2((s_g + direction.x) * lobe_scale_bias.x + lobe_scale_bias.y, asin(s_g) / 3.14159265358979 + 0.5);
    // Samples over the footprint with its variance, no farther apart than the width of the lobe: lobe_radiance().
    int taps = footprint > 0.0 ? clamp(int(ceil(footprint * inversesqrt(lobe.moments.z * across2))), 2, 16) : 1;
    float aside = taps > 1 ? footprint * lobe_scale_bias.x * inversesqrt(1.0 - 1.0 / float(taps * taps)) : 0.0;
    vec3 value = vec3(0.0);
    for (int i = 0; i < taps; ++i) {
        float s = uv.x + aside * (float(2 * i + 1) / float(taps) - 1.0);
        value += textureLod(lobe_table, vec3(s, uv.y, light), 0.0).xyz;
    }
    value /= float(taps);
    vec2 along = spread_along_grooves(lobe, axis);
    float flux = max(max(lobe.flux.r, lobe.flux.g), lobe.flux.b);
    return lobe_scale_bias.z * flux * height * key_groove_factor(along.x + direction.y, along.y) * value;
}

vec3 key_lights_xyz(mat3 axes, vec3 direction, float footprint) {
    vec3 xyz = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) xyz += key_lobe_xyz(i, axes, direction, footprint);
    return xyz;
}

#endif

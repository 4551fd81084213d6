// A flat object's map over the azimuth of g in its plane and v_g: planar_map.h. With LOBE_MAP it is over v_h as well:
// lobe_map.h; with HALF_TURN over half of the azimuths. With PITCH_AXIS it is over pitches as well.
#ifdef LOBE_MAP
TEXTURE_UNIT(11) uniform sampler3D lobe_map;
uniform vec4 lobe_map_axes;  // scales of v_g, v_h and the azimuth, offset of the azimuth
#else
#ifdef PITCH_AXIS
TEXTURE_UNIT(11) uniform sampler3D planar_map;
uniform vec2 pitch_scale_bias;  // from the logarithm of the pitch factor to the map's third coordinate
#else
TEXTURE_UNIT(11) uniform sampler2D planar_map;
#endif
uniform vec2 planar_map_half_texel;
#endif
uniform vec3 planar_e1;  // the azimuth's axes in the world
uniform vec3 planar_e2;
uniform float map_scale;  // of the stored values

// atan(y, x) / 2π within 2e-6. Minimax polynomial; the GPU's own function takes twice as long.
float turns(float y, float x) {
    float longer = max(abs(x), abs(y));
    float t = min(abs(x), abs(y)) / max(longer, 1e-30);
    float s = t * t;
    float eighth = t * (0.1591337 + s * (-0.0525696 + s * (0.0286730 + s * (-0.0135527 + s * 0.0033174))));
    float quarter = abs(y) > abs(x) ? 0.25 - eighth : eighth;
    float half_turn = x < 0.0 ? 0.5 - quarter : quarter;
    return y < 0.0 ? -half_turn : half_turn;
}

// In the colour space of the stored values.
#ifdef LOBE_MAP
vec3 map_radiance(vec2 v, vec3 g) {
    float azimuth = turns(dot(g, planar_e2), dot(g, planar_e1));
#ifdef HALF_TURN
    if (azimuth < 0.0) {
        azimuth += 0.5;
        v = -v;
    }
#endif
    vec3 uvw = vec3(0.5 + v * lobe_map_axes.xy, azimuth * lobe_map_axes.z + lobe_map_axes.w);
    return map_scale * textureLod(lobe_map, uvw, 0.0).xyz;
}
#else
vec2 planar_map_uv(float v_g, vec3 g) {
    vec2 half_texel = planar_map_half_texel;
    return vec2(turns(dot(g, planar_e2), dot(g, planar_e1)) + half_texel.x, 0.5 + v_g * (0.5 - half_texel.y));
}
#ifdef PITCH_AXIS
vec3 map_radiance_of_pitch(float v_g, vec3 g, float pitch) {
    float slice = log(pitch) * pitch_scale_bias.x + pitch_scale_bias.y;
    return map_scale * textureLod(planar_map, vec3(planar_map_uv(v_g, g), slice), 0.0).xyz;
}
#else
vec3 map_radiance(float v_g, vec3 g, vec3 n) {
    return map_scale * textureLod(planar_map, planar_map_uv(v_g, g), 0.0).xyz;
}
#endif
#endif

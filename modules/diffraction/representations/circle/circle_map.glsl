// A map over g in the world and v_g, Fourier terms of the normal's angle around g: circle_map.h. The program defines
// CHARTS, TERMS, LOOK_UPS and VIEWS. A look-up holds four components of the terms' values, which follow each other:
// red, green and blue of the first term, red of the second. Look-ups lie side by side, charts below each other.
// Filtering never reaches a neighbour, as the equator lies 1.5 texels inside.
TEXTURE_UNIT(11) uniform sampler3D circle_map;
uniform float circle_map_scale;  // chart coordinates to texture coordinates
uniform float map_scale;  // of the stored values

// In the colour space of the stored values.
vec3 map_radiance(float v_g, vec3 g, vec3 n) {
    bool lower = g.y < 0.0;
#if CHARTS == 1
    if (lower) {
        g = -g;
        v_g = -v_g;
    }
    float up = 1.0;
    float chart = 0.0;
#else
    float up = lower ? -1.0 : 1.0;
    float chart = lower ? 1.0 : 0.0;
#endif
    vec2 p = g.xz / (1.0 + up * g.y);
    vec2 st = 0.5 + p * circle_map_scale;
    vec2 t1 = n.xz - up * n.y * p;  // n·e1 and n·e2, as n·g = 0
    vec2 t2 = vec2(t1.x * t1.x - t1.y * t1.y, 2.0 * t1.x * t1.y);
    vec2 t4 = vec2(t2.x * t2.x - t2.y * t2.y, 2.0 * t2.x * t2.y);
#ifdef COVER
    vec2 t3 = vec2(t1.x * t2.x - t1.y * t2.y, t1.x * t2.y + t1.y * t2.x);
    vec2 t5 = vec2(t1.x * t4.x - t1.y * t4.y, t1.x * t4.y + t1.y * t4.x);
    float factors[11] = float[11](1.0, t1.x, t1.y, t2.x, t2.y, t4.x, t4.y, t3.x, t3.y, t5.x, t5.y);
#else
    vec2 t6 = vec2(t4.x * t2.x - t4.y * t2.y, t4.x * t2.y + t4.y * t2.x);
    float factors[9] = float[9](1.0, t1.x, t1.y, t2.x, t2.y, t4.x, t4.y, t6.x, t6.y);
#endif
    float r = 0.5 + v_g * (0.5 - 0.5 / float(VIEWS));
    vec3 sum = vec3(0.0);
    for (int look_up = 0; look_up < LOOK_UPS; ++look_up) {
        vec2 at = (st + vec2(look_up, chart)) / vec2(LOOK_UPS, CHARTS);
        vec4 values = textureLod(circle_map, vec3(at, r), 0.0);
        for (int i = 0; i < 4; ++i) {
            int component = 4 * look_up + i;
            if (component < 3 * TERMS) sum[component % 3] += factors[component / 3] * values[i];
        }
    }
    return map_scale * sum;
}

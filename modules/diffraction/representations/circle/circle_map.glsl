// A map over g in the world and v_g, Fourier terms of the normal's angle around g: circle_map.h. The program defines
// CHARTS, TERMS, LOOK_UPS (side by side in the texture) and VIEWS. A look-up holds four components of the terms' values,
// which follow each other: red, green and blue of the first term, red of the second. Charts lie below each other.
// Filtering never reaches a neighbour, as the equator lies 1.5 texels inside. Level 0 holds five terms, level 1 the rest.
TEXTURE_UNIT(11) uniform sampler3D circle_map;
uniform vec2 circle_map_scales;  // chart coordinates to texture coordinates, of each level
uniform float map_scale;  // of the stored values

const int FINE_TERMS = 5;

// The sum of the terms in a level from `first` on.
vec3 terms_from(int first, int terms, int level, float chart, vec2 p, float v_g, float factors[11]) {
    vec2 st = 0.5 + p * (level == 0 ? circle_map_scales.x : circle_map_scales.y);
    float r = 0.5 + v_g * (0.5 - (level == 0 ? 0.5 : 1.0) / float(VIEWS));
    vec3 sum = vec3(0.0);
    for (int component = 0; component < 3 * terms; component += 4) {
        vec2 at = (st + vec2(component / 4, chart)) / vec2(LOOK_UPS, CHARTS);
        vec4 values = textureLod(circle_map, vec3(at, r), float(level));
        // AMD's compiler unrolls loops of one condition only.
        for (int i = 0; i < 4; ++i)
            if (component + i < 3 * terms) sum[(component + i) % 3] += factors[first + (component + i) / 3] * values[i];
    }
    return sum;
}

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
    vec2 t1 = n.xz - up * n.y * p;  // n·e1 and n·e2, as n·g = 0
    vec2 t2 = vec2(t1.x * t1.x - t1.y * t1.y, 2.0 * t1.x * t1.y);
    vec2 t4 = vec2(t2.x * t2.x - t2.y * t2.y, 2.0 * t2.x * t2.y);
#ifdef COVER
    vec2 t3 = vec2(t1.x * t2.x - t1.y * t2.y, t1.x * t2.y + t1.y * t2.x);
    vec2 t5 = vec2(t1.x * t4.x - t1.y * t4.y, t1.x * t4.y + t1.y * t4.x);
    float factors[11] = float[11](1.0, t1.x, t1.y, t2.x, t2.y, t4.x, t4.y, t3.x, t3.y, t5.x, t5.y);
#else
    vec2 t6 = vec2(t4.x * t2.x - t4.y * t2.y, t4.x * t2.y + t4.y * t2.x);
    float factors[11] = float[11](1.0, t1.x, t1.y, t2.x, t2.y, t4.x, t4.y, t6.x, t6.y, 0.0, 0.0);
#endif
    vec3 sum = terms_from(0, FINE_TERMS, 0, chart, p, v_g, factors);
#if TERMS > 5
    sum += terms_from(FINE_TERMS, TERMS - FINE_TERMS, 1, chart, p, v_g, factors);
#endif
    return map_scale * sum;
}

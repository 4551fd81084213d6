// A map over g in the world and v_g, Fourier terms of the normal's angle around g: circle_map.h. The program defines
// CHARTS and ANGLES. A look-up of the terms holds four components of their values, which follow each
// other: red, green and blue of the first term, red of the second. Look-ups lie side by side in the texture, charts
// below each other. Filtering never reaches a neighbour, as the equator lies 1.5 texels inside.
TEXTURE_UNIT(11) uniform sampler3D circle_map;
// From chart coordinates (xy) and v_g (zw) to texture coordinates, of the terms (xz) and of the rest (yw).
uniform vec4 circle_map_scales;
uniform float map_scale;         // of the stored values

const int TERMS = 5;
const int LOOK_UPS = 4;

vec3 circle_terms(float chart, vec2 p, float v_g, float factors[5]) {
    vec2 st = 0.5 + p * circle_map_scales.x;
    float r = 0.5 + v_g * circle_map_scales.z;
    vec3 sum = vec3(0.0);
    for (int look_up = 0; look_up < LOOK_UPS; ++look_up) {
        vec2 at = (st + vec2(look_up, chart)) / vec2(LOOK_UPS, CHARTS);
        vec4 values = textureLod(circle_map, vec3(at, r), 0.0);
        // AMD's compiler unrolls loops of one condition only.
        for (int i = 0; i < 4; ++i) {
            int component = 4 * look_up + i;
            if (component < 3 * TERMS) sum[component % 3] += factors[component / 3] * values[i];
        }
    }
    return map_scale * sum;
}

#if ANGLES > 0
// The rest of the series, in ten bits of either sign: a function for each angle, linear between two.
TEXTURE_UNIT(9) uniform sampler3D circle_rest;
uniform float second_map_scale;

#ifdef COVER
const int REST_ANGLES = 2 * ANGLES;
#else
const int REST_ANGLES = ANGLES;  // the period is half a turn
#endif

// `t`: cosine and sine of the angle whose period the rest has. Angles lie side by side, and the texture repeats.
vec3 circle_rest_at(float chart, vec2 p, float v_g, vec2 t) {
    vec2 size = abs(t);
    float y = (size.x - size.y) / (size.x + size.y);
    float from_axis = 0.5 + y * (0.6 - 0.1 * y * y);  // circle_map.h: circle_turn(), here in quarters
    float turn = t.x < 0.0 ? 1.0 + from_axis : 1.0 - from_axis;
    float position = (t.y < 0.0 ? -turn : turn) * (float(REST_ANGLES) / 4.0);
    float low = floor(position);
    vec2 st = 0.5 + p * circle_map_scales.y;
    vec3 at = vec3((st.x + low) / float(REST_ANGLES), (st.y + chart) / float(CHARTS),
                   0.5 + v_g * circle_map_scales.w);
    vec3 first = textureLod(circle_rest, at, 0.0).rgb;
    at.x += 1.0 / float(REST_ANGLES);
    vec3 second = textureLod(circle_rest, at, 0.0).rgb;
    return second_map_scale * (2.0 * mix(first, second, position - low) - 1.0);
}
#endif

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
    vec2 t = n.xz - up * n.y * p;  // n·e1 and n·e2, as n·g = 0
    vec2 t2 = vec2(t.x * t.x - t.y * t.y, 2.0 * t.x * t.y);  // of twice the angle
    vec3 sum = circle_terms(chart, p, v_g, float[5](1.0, t.x, t.y, t2.x, t2.y));
#if ANGLES > 0
#ifdef COVER
    sum += circle_rest_at(chart, p, v_g, t);
#else
    sum += circle_rest_at(chart, p, v_g, t2);
#endif
#endif
    return sum;
}

#ifdef VERTEX_STAGE
vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    return view.z > 0.0 ? map_radiance(view.x, g, n) : vec3(0.0);
}
#else
vec3 diffracted_radiance(GrooveView view) { return map_radiance(view.direction.x, view.axes[0], view.axes[2]); }
#endif

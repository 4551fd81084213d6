// A narrow lobe mirrors the probe along the grooves and disperses it across them: streak.h, evaluate(). The program
// defines NODES, the number of nodes of a segment, and REST where an arc table shades the incoherent part of Stam's
// pits.
#include "modules/diffraction/representations/streak/streak_path.glsl"
#ifdef REST
#include "modules/diffraction/representations/arc/arc.glsl"
#endif

// A segment: x: its first path over the pitch; y: its step over the pitch. Then for each node the columns of its
// weight, for red, green and blue light, in the working space.
#ifdef GL_ES
STORAGE(6, StreakSegments, vec4, streak_segments);
uniform int streak_segment_count;
vec4 segment_first_step(int i) { return STORED_VEC4(streak_segments, i * (1 + 3 * NODES)); }
vec4 segment_weight(int i, int k) { return STORED_VEC4(streak_segments, i * (1 + 3 * NODES) + 1 + k); }
#else
struct StreakSegment {
    vec4 first_step;
    vec4 weights[3 * NODES];
};
layout(std430, binding = 6) readonly buffer StreakSegments { StreakSegment streak_segments[]; };
#define streak_segment_count streak_segments.length()
vec4 segment_first_step(int i) { return streak_segments[i].first_step; }
vec4 segment_weight(int i, int k) { return streak_segments[i].weights[k]; }
#endif
uniform float streak_reach;  // streak.h: Streak::reach()
uniform float streak_power;
uniform float rest_weight;

// Values that are the same for all nodes of a view.
struct StreakView {
    float all;     // radius sqrt(1 - s_g^2) from which on all of the lobe is above the horizon
    float half_sign;  // half the sign of s_h
    float limit;  // of |s_g|
    vec2 above;   // the fraction above the horizon: x - y s_g^2
};

StreakView streak_view(GrooveView view) {
    float side = abs(view.direction.y);
    float some = max(side - streak_reach, 0.0);
    float all = side + streak_reach;
    float scale = 1.0 / (all * all - some * some);
    float square = 1.0 - some * some;
    return StreakView(all, view.direction.y > 0.0 ? -0.5 : 0.5, sqrt(max(square, 0.0)), scale * vec2(square, 1.0));
}

// s_n^2 of the direction (s_g, s_h).
float square_n(float s_g, float s_h) { return max(1.0 - s_g * s_g - s_h * s_h, 1e-4); }

// chart_coordinates() of the light at (s_g, s_h).
vec3 lobe_position(float s_g, float s_h, float up, mat3 axes) {
    float s_n = sqrt(square_n(s_g, s_h));
    return chart_coordinates(axes * vec3(s_g, s_h, s_n), axes[1] * s_n - axes[2] * s_h, up);
}

vec3 segment_radiance(int i, StreakView at, GrooveView view) {
    float first = segment_first_step(i).x / view.pitch - view.direction.x;
    float step_g = segment_first_step(i).y / view.pitch;
    float low = max(first, -at.limit);
    float high = min(first + float(NODES - 1) * step_g, at.limit);
    vec3 sum = vec3(0.0);
    if (low <= high) {
        float middle = 0.5 * (low + high);
        float square_r = max(1.0 - middle * middle, 1e-6);
        // The middle of the lobe's part above the horizon.
        float s_h = at.half_sign * min(sqrt(square_r) - at.all, 0.0) - view.direction.y;
        float square = square_n(middle, s_h);
        vec3 centre = view.axes * vec3(middle, s_h, sqrt(square));
        float level = 0.5 * log2(square_r / square) + streak_level;
        float up = centre.y < 0.0 ? -1.0 : 1.0;
        StreakPath path = streak_path(lobe_position(low, s_h, up, view.axes), centre,
                                      lobe_position(high, s_h, up, view.axes), up);
        float extent = max(0.5 * (high - low), 5e-7);
        float first_t = (first - middle) / extent;
        float step_t = step_g / extent;
        // The fraction above the horizon as a polynomial of t.
        float bent = at.above.y * extent;
        vec3 above = vec3(at.above.x - at.above.y * middle * middle, -bent * (low + high), -bent * extent);
        for (int j = 0; j < NODES; ++j) {
            float t = first_t + float(j) * step_t;
            float fraction = clamp(above.x + t * (above.y + t * above.z), 0.0, 1.0) *
                             cover_transmittance(sqrt(square_n(middle + t * extent, s_h)));
            vec3 rgb = fraction * streak_light(path, t, level);
            for (int c = 0; c < 3; ++c) sum += segment_weight(i, 3 * j + c).xyz * rgb[c];
        }
    }
    return sum;
}

vec3 diffracted_radiance(GrooveView view) {
    StreakView at = streak_view(view);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < streak_segment_count; ++i) sum += segment_radiance(i, at, view);
    sum *= streak_power * map_scale;
#ifdef REST
    sum += rest_weight * arc_radiance(view);
#endif
    return sum;
}

#version 450 core
// The orders of a lattice as nodes on rays of u, each a look-up of the probe blurred along its ray: lattice_streak.h,
// evaluate(). The program defines NODES, those of a segment.
#include "modules/diffraction/shaders/surface.glsl"
#include "modules/diffraction/representations/streak/streak_path.glsl"

struct StreakSegment {
    vec4 first_step;           // |u| of the first node; between two; zw: the ray's direction, (g, h)
    vec4 weights[3 * NODES];  // for each node the columns: of red, green and blue light, working space
};
layout(std430, binding = 6) readonly buffer StreakSegments { StreakSegment streak_segments[]; };

const float LEAST_STEP = 1e-6;

float square_n(vec2 s_p) { return max(1.0 - dot(s_p, s_p), 1e-4); }

// Of the light at u = s_p + v_p.
vec3 lobe_position(vec2 s_p, vec2 ray, float up, mat3 axes) {
    float s_n = sqrt(square_n(s_p));
    return streak_position(axes * vec3(s_p, s_n), axes * vec3(s_n * ray, -dot(ray, s_p)), up);
}

vec3 segment_radiance(int i, GrooveView view, float mirrored) {
    vec2 v_p = view.direction.xy;
    vec2 ray = streak_segments[i].first_step.zw;
    // How far the ray is above the horizon: u = 0, the mirror's direction, is.
    float b = dot(ray, v_p);
    float horizon = b + sqrt(max(b * b + mirrored, 0.0));
    float first = streak_segments[i].first_step.x;
    float step_r = max(streak_segments[i].first_step.y, LEAST_STEP);
    vec3 sum = vec3(0.0);
    if (first <= horizon + 0.5 * step_r) {
        float low = min(first, horizon);
        float high = min(first + float(NODES - 1) * step_r, horizon);
        float middle = 0.5 * (low + high);
        vec2 s_p = middle * ray - v_p;
        float square = square_n(s_p);
        float along = dot(ray, s_p);
        float level = 0.5 * log2(1.0 + along * along / square) + streak_level;
        vec3 centre = view.axes * vec3(s_p, sqrt(square));
        float up = centre.y < 0.0 ? -1.0 : 1.0;
        StreakPath path = streak_path(lobe_position(low * ray - v_p, ray, up, view.axes), centre,
                                      lobe_position(high * ray - v_p, ray, up, view.axes), up);
        float scale = 2.0 / max(high - low, LEAST_STEP);
        float per_step = 1.0 / step_r;
        for (int j = 0; j < NODES; ++j) {
            float distance_j = first + float(j) * step_r;
            float r = min(distance_j, high);
            float t = scale * (r - middle);
            float fraction = clamp((horizon - distance_j) * per_step + 0.5, 0.0, 1.0) *
                             cover_transmittance(sqrt(square_n(r * ray - v_p)));
            vec3 rgb = fraction * streak_light(path, t, level);
            for (int c = 0; c < 3; ++c) sum += streak_segments[i].weights[3 * j + c].xyz * rgb[c];
        }
    }
    return sum;
}

vec3 diffracted_radiance(GrooveView view) {
    float mirrored = 1.0 - dot(view.direction.xy, view.direction.xy);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < streak_segments.length(); ++i) sum += segment_radiance(i, view, mirrored);
    return map_scale * sum;
}

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

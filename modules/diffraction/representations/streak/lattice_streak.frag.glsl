#version 450 core
// The orders of a lattice as nodes on rays of u, each a look-up of the probe blurred along its ray: lattice_streak.h,
// evaluate(). The program defines NODES, those of a segment.
#include "modules/diffraction/shaders/surface.glsl"

struct StreakSegment {
    vec4 first_step;           // |u| of the first node; between two; zw: the ray's direction, (g, h)
    vec4 weights[3 * NODES];  // for each node the columns: of red, green and blue light, working space
};
layout(std430, binding = 6) readonly buffer StreakSegments { StreakSegment streak_segments[]; };
TEXTURE_UNIT(11) uniform sampler3D streak_map;  // streak_map.h
uniform float map_scale;                            // of the stored values
uniform float streak_level;                         // log2 of a node's deviation in u over the map's

const float CHART_SCALE = 0.5 / 1.1;
const float RIM = 0.905;
const float LEAST_STEP = 1e-6;

float square_n(vec2 s_p) { return max(1.0 - dot(s_p, s_p), 1e-4); }

// Half a sphere of directions.
vec2 chart_position(vec3 s, float up) { return s.xz / max(1.0 + up * s.y, RIM); }

// Position in the chart; direction of the ray there as a texture coordinate.
vec3 ray_position(vec2 s_p, vec2 ray, float up, mat3 axes) {
    float s_n = sqrt(square_n(s_p));
    vec2 p = chart_position(axes * vec3(s_p, s_n), up);
    vec3 along = axes * vec3(s_n * ray, -dot(ray, s_p));
    vec2 image = along.xz - up * along.y * p;
    float turn = image.x / (abs(image.x) + abs(image.y));
    return vec3(p, 0.5 + 0.5 * (image.y < 0.0 ? turn : -turn));
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
        vec3 before = ray_position(low * ray - v_p, ray, up, view.axes);
        vec3 after = ray_position(high * ray - v_p, ray, up, view.axes);
        after.z -= round(after.z - before.z);
        // A parabola in the chart; the ray's direction is linear.
        vec3 mean = 0.5 * (after + before);
        vec3 slope = 0.5 * (after - before);
        vec2 bend = mean.xy - chart_position(centre, up);
        mean.xy -= bend;
        vec2 chart = vec2(0.5 * CHART_SCALE, CHART_SCALE);
        mean.xy = vec2(0.5 - 0.25 * up, 0.5) + chart * mean.xy;
        slope.xy *= chart;
        bend *= chart;
        float scale = 2.0 / max(high - low, LEAST_STEP);
        float per_step = 1.0 / step_r;
        for (int j = 0; j < NODES; ++j) {
            float distance_j = first + float(j) * step_r;
            float r = min(distance_j, high);
            float t = scale * (r - middle);
            float fraction = clamp((horizon - distance_j) * per_step + 0.5, 0.0, 1.0) *
                             cover_transmittance(sqrt(square_n(r * ray - v_p)));
            vec2 chart_at = mean.xy + t * (slope.xy + t * bend);
            vec3 rgb = fraction * textureLod(streak_map, vec3(chart_at, mean.z + t * slope.z), level).rgb;
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

#version 450 core
// A narrow lobe mirrors the probe along the grooves and disperses it across them: streak.h, evaluate(). The program
// defines TAPS, and REST where an arc table shades the incoherent rest of Stam's pits.
#include "modules/diffraction/shaders/surface.glsl"
#include "modules/diffraction/shaders/radiance_cube.glsl"
#ifdef REST
#include "modules/diffraction/representations/arc/arc_sum.glsl"
#endif

struct StreakNode {
    vec4 path_width; // x: path over the pitch; y: width over the pitch
    vec4 weight[3];  // columns: of red, green and blue light, working space
};
layout(std430, binding = 6) readonly buffer StreakNodes { StreakNode streak_nodes[]; };
uniform vec3 streak_taps[TAPS];  // offset and width in s_h; weight
uniform float streak_power;
uniform float rest_weight;

const float LOWEST_HEIGHT = 0.02;

// An interval of a direction cosine, clipped to +-limit: its middle, its length, and the fraction that remains.
vec3 cut(float middle, float extent, float limit) {
    if (extent <= 0.0) return vec3(middle, 0.0, abs(middle) < limit ? 1.0 : 0.0);
    float begin = max(middle - 0.5 * extent, -limit);
    float end = min(middle + 0.5 * extent, limit);
    return vec3(0.5 * (begin + end), end - begin, max(end - begin, 0.0) / extent);
}

// Mean over the lobe of the light about the arc's interval `across`.
vec3 lobe_radiance(vec3 across, GrooveView view) {
    float r2 = max((1.0 - across.x) * (1.0 + across.x), 0.0);
    vec3 rgb = vec3(0.0);
    for (int i = 0; i < TAPS; ++i) {
        vec3 tap = streak_taps[i];
        vec3 along = cut(tap.x - view.direction.y, tap.y, sqrt(r2));
        if (along.z == 0.0) continue;
        float height = sqrt(max(r2 - along.x * along.x, 0.0));
        float slope = 1.0 / max(height, LOWEST_HEIGHT);
        rgb += tap.z * along.z * cover_transmittance(height) *
               mean_radiance(vec3(across.x, along.x, height), across.y * vec3(1.0, 0.0, -across.x * slope),
                             along.y * vec3(0.0, 1.0, -along.x * slope), view.axes);
    }
    return rgb;
}

vec3 diffracted_radiance(GrooveView view) {
    vec3 sum = vec3(0.0);
    for (int k = 0; k < streak_nodes.length(); ++k) {
        vec2 path_width = streak_nodes[k].path_width.xy;
        vec3 across = cut(path_width.x / view.pitch - view.direction.x, path_width.y / view.pitch, 1.0);
        if (across.z == 0.0) continue;
        vec3 rgb = across.z * lobe_radiance(across, view);
        for (int c = 0; c < 3; ++c) sum += streak_nodes[k].weight[c].xyz * rgb[c];
    }
    sum *= streak_power;
#ifdef REST
    sum += rest_weight * arc_radiance(view);
#endif
    return sum;
}

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

#version 450 core
// The light that the lens spreads over each pixel: depth_of_field.h.
#include "engine/gpu/shaders/dialect.glsl"

layout(location = 0) out vec4 blurred;

layout(binding = 0) uniform sampler2D scene_linear;
layout(binding = 1) uniform sampler2D discs;
layout(binding = 2) uniform sampler2D widest_in_tile;
uniform int tile;
uniform bool into_halves;

const int MOST_SAMPLES = 96;
const float PI = 3.14159265358979;
const float PIXEL = 0.56418958;  // radius of a disc as large as a pixel
const float SHARP = 0.75;        // up to this radius a disc is seen as a pixel

// Largest radius of the discs that may reach the pixel: none is larger than a tile's side.
float widest_nearby(ivec2 pixel) {
    ivec2 last = textureSize(widest_in_tile, 0) - 1;
    float widest = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x)
            widest = max(widest, texelFetch(widest_in_tile, clamp(pixel / tile + ivec2(x, y), ivec2(0), last), 0).x);
    return widest;
}

float disc_area(float radius) { return PI * radius * radius; }

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 source = texelFetch(scene_linear, pixel, 0);
    float own = texelFetch(discs, pixel, 0).a;
    float widest = widest_nearby(pixel);
    blurred = source;
    if (widest > SHARP) {
        int samples = clamp(int(disc_area(widest)), 8, MOST_SAMPLES);
        float spacing = widest * sqrt(PI / float(samples));
        float level = log2(max(spacing, 1.0));
        vec2 size = vec2(textureSize(discs, 0));
        // Light and the fraction of the pixel that it covers, for nearer surfaces, and for the pixel's own and farther
        // ones.
        vec4 front = vec4(0.0);
        vec4 behind = vec4(source.rgb, 1.0) / disc_area(max(abs(own), PIXEL));
        for (int i = 0; i < samples; ++i) {
            float reach = widest * sqrt((float(i) + 0.5) / float(samples));
            float angle = 2.39996322972865 * float(i);
            vec4 other = textureLod(discs, (gl_FragCoord.xy + reach * vec2(cos(angle), sin(angle))) / size, level);
            bool nearer = other.a < own - SHARP;
            float radius = abs(other.a);
            if (other.a > own) radius = min(radius, 2.0 * abs(own));
            float covers = clamp((radius - reach) / spacing + 0.5, 0.0, 1.0);
            float weight = covers * disc_area(widest) / (float(samples) * disc_area(max(radius, PIXEL)));
            if (nearer)
                front += weight * vec4(other.rgb, 1.0);
            else
                behind += weight * vec4(other.rgb, 1.0);
        }
        vec3 light = mix(behind.rgb / behind.a, front.rgb / max(front.a, 1e-6), min(front.a, 1.0));
        blurred = vec4(light, source.a);
    }
    if (into_halves) blurred = rounded_to_half(blurred);
}

#version 450 core

#include "bloom_grid.glsl"

layout(location = 0) out vec4 light_and_area;

uniform ivec2 coarse_size;

void main() {
    ivec2 coarse = ivec2(gl_FragCoord.xy);
    ivec2 first = max(2 * coarse - 1, ivec2(0));
    ivec2 last = min(2 * coarse + 2, textureSize(fine, 0) - 1);
    vec4 sum = vec4(0.0);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            vec2 distance = abs(coarse_position(ivec2(x, y), coarse_size) - vec2(coarse));
            vec2 weight = max(1.0 - distance, vec2(0.0));
            sum += weight.x * weight.y * fine_texel(ivec2(x, y));
        }
    }
    light_and_area = rounded_to_half(0.25 * sum);
}

#version 450 core

#include "bloom_grid.glsl"

layout(location = 0) out vec4 mixed;

layout(binding = 1) uniform sampler2D coarse;
uniform float coarse_weight;
uniform bool into_halves;

vec3 coarse_value(int x, int y) {
    vec4 texel = texelFetch(coarse, ivec2(x, y), 0);
    return texel.rgb / texel.a;
}

vec3 interpolated(ivec2 fine_position) {
    ivec2 size = textureSize(coarse, 0);
    vec2 position = coarse_position(fine_position, size);
    ivec2 low = ivec2(position);
    ivec2 high = min(low + 1, size - 1);
    vec2 part = position - vec2(low);
    vec3 lower = mix(coarse_value(low.x, low.y), coarse_value(high.x, low.y), part.x);
    vec3 upper = mix(coarse_value(low.x, high.y), coarse_value(high.x, high.y), part.x);
    return mix(lower, upper, part.y);
}

void main() {
    ivec2 position = ivec2(gl_FragCoord.xy);
    vec4 here = fine_texel(position);
    vec3 value = mix(here.rgb / here.a, interpolated(position), coarse_weight);
#if FINE_IS_PICTURE
    mixed = vec4(value, texelFetch(fine, position, 0).a);
    if (into_halves) mixed = rounded_to_half(mixed);
#else
    mixed = rounded_to_half(vec4(value, 1.0));
#endif
}

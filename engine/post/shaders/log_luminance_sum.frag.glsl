#version 450 core

layout(location = 0) out vec2 sum_and_count;

// The one texel of the last pass, for the CPU.
layout(std430, binding = 0) writeonly buffer Total { vec2 total; };
uniform bool is_total;

layout(binding = 0) uniform sampler2D source;
#if SOURCE_IS_PICTURE
uniform vec3 weights;
uniform float darkest;
#endif

const int block = 8;  // as in auto_exposure.cpp

vec2 logarithm_and_count(ivec2 position) {
#if SOURCE_IS_PICTURE
    float luminance = dot(weights, texelFetch(source, position, 0).rgb);
    // Bits are tested, because compilers may assume that isnan and isinf are false.
    bool is_finite = (floatBitsToUint(luminance) & 0x7fffffffu) < 0x7f800000u;
    return is_finite ? vec2(log2(max(luminance, darkest)), 1.0) : vec2(0.0);
#else
    return texelFetch(source, position, 0).rg;
#endif
}

void main() {
    ivec2 first = block * ivec2(gl_FragCoord.xy);
    ivec2 end = min(first + block, textureSize(source, 0));
    sum_and_count = vec2(0.0);
    for (int y = first.y; y < end.y; ++y) {
        for (int x = first.x; x < end.x; ++x) sum_and_count += logarithm_and_count(ivec2(x, y));
    }
    if (is_total) total = sum_and_count;
}

#version 450 core

layout(location = 0) out vec4 noisy;

layout(binding = 0) uniform sampler2D display_value;
uniform int frame;
uniform float step_size;  // 0: no dither
uniform float grain;      // 0: none

// Dither in steps of the target: noise.h.
float dither_offset(uvec2 pixel) {
    // 2^32 over the plastic number 1.32471795724, over its square, and over the golden ratio.
    uint phase = pixel.x * 0xc13fa9a9u + pixel.y * 0x91e10da5u + uint(frame) * 0x9e3779b9u;
    // Ten bits: float sums of a display value and its noise keep them.
    return (float(phase >> 22) + 0.5) / 1024.0 - 0.5;
}

// PCG [Jarzynski & Olano 2020].
uint hashed(uint value) {
    uint state = value * 747796405u + 2891336453u;
    uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

// Sum of four bytes, less its mean of 510: nearly normal.
int grain_of(uvec2 pixel) {
    uint bits = hashed(pixel.x + hashed(pixel.y + hashed(uint(frame))));
    return int((bits & 255u) + ((bits >> 8) & 255u) + ((bits >> 16) & 255u) + (bits >> 24)) - 510;
}

// Grain of mean 0 and variance 1: the sum over 3x3 pixels, weighted 1, 2, 1 either way, divided by its standard
// deviation, which is 6 times that of one pixel.
float grain_offset(uvec2 pixel) {
    int sum = 0;
    for (uint y = 0u; y < 3u; ++y)
        for (uint x = 0u; x < 3u; ++x) sum += (2 - abs(int(x) - 1)) * (2 - abs(int(y) - 1)) * grain_of(pixel + uvec2(x, y));
    return float(sum) / (6.0 * 147.7994136);
}

void main() {
    uvec2 pixel = uvec2(gl_FragCoord.xy);
    vec4 value = texelFetch(display_value, ivec2(pixel), 0);
    float offset = step_size * dither_offset(pixel);
    if (grain > 0.0) {
        float mean = clamp(dot(value.rgb, vec3(1.0 / 3.0)), 0.0, 1.0);
        offset += grain * 2.0 * sqrt(mean * (1.0 - mean)) * grain_offset(pixel);
    }
    noisy = vec4(value.rgb + offset, value.a);
}

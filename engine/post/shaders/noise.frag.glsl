#version 450 core

layout(location = 0) out vec4 dithered;

layout(binding = 0) uniform sampler2D display_value;
uniform int frame;
uniform float step_size;

// In steps of the target: display_pass.h.
float dither_offset(uvec2 pixel) {
    // 2^32 over the plastic number 1.32471795724, over its square, and over the golden ratio.
    uint phase = pixel.x * 0xc13fa9a9u + pixel.y * 0x91e10da5u + uint(frame) * 0x9e3779b9u;
    // Ten bits: float sums of a display value and its noise keep them.
    return (float(phase >> 22) + 0.5) / 1024.0 - 0.5;
}

void main() {
    vec4 value = texelFetch(display_value, ivec2(gl_FragCoord.xy), 0);
    dithered = vec4(value.rgb + step_size * dither_offset(uvec2(gl_FragCoord.xy)), value.a);
}

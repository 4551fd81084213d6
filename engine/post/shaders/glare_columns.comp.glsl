#version 450 core

#include "glare_fourier.glsl"

layout(binding = 0, rg32f) uniform image2DArray spectrum;
#if OF_KERNEL
layout(binding = 1, rg32f) uniform writeonly image2DArray kernel_out;
uniform int channel_in;
#else
layout(binding = 2) uniform sampler2DArray kernel;
#endif
uniform int rows;  // that hold light

void load(int column, int row) {
    for (int channel = 0; channel < 3; ++channel)
        values[channel][row] =
            row < rows ? imageLoad(spectrum, ivec3(column, row, channel)).xy : vec2(0.0);
}

#if OF_KERNEL
void store(int column, int row) {
    for (int channel = 0; channel < 3; ++channel)
        imageStore(kernel_out, ivec3(column, row, 3 * channel_in + channel), vec4(values[channel][row], 0.0, 0.0));
}
#else
// Light and kernel hold the frequencies in the same order.
void multiply(int column, int row) {
    vec2 light[3] = vec2[3](values[0][row], values[1][row], values[2][row]);
    for (int channel = 0; channel < 3; ++channel) {
        vec2 sum = vec2(0.0);
        for (int from = 0; from < 3; ++from)
            sum += product(texelFetch(kernel, ivec3(column, row, 3 * from + channel), 0).xy, light[from]);
        values[channel][row] = sum;
    }
}

void store(int column, int row) {
    if (row >= rows) return;
    for (int channel = 0; channel < 3; ++channel)
        imageStore(spectrum, ivec3(column, row, channel), vec4(values[channel][row], 0.0, 0.0));
}
#endif

void main() {
    int column = int(gl_WorkGroupID.x);
    int lower = int(gl_LocalInvocationIndex);
    int upper = lower + LENGTH / 2;
    load(column, lower);
    load(column, upper);
    forward();
#if !OF_KERNEL
    multiply(column, lower);
    multiply(column, upper);
    inverse();
#endif
    store(column, lower);
    store(column, upper);
}

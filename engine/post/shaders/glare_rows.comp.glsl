#version 450 core

#include "glare_fourier.glsl"

layout(binding = 0) uniform sampler2D cells_of_light;
layout(binding = 0, rg32f) uniform writeonly image2DArray spectrum;

vec3 light(ivec2 at) {
    return all(lessThan(at, textureSize(cells_of_light, 0))) ? texelFetch(cells_of_light, at, 0).rgb : vec3(0.0);
}

// Stores the spectra of two rows a, b of real numbers, which were transformed as a + ib.
void store(int frequency, int row, int channel) {
    vec2 here = values[0][reversed(uint(frequency))];
    vec2 mirrored = values[0][reversed(uint((LENGTH - frequency) % LENGTH))];
    vec2 a = 0.5 * vec2(here.x + mirrored.x, here.y - mirrored.y);
    vec2 b = 0.5 * vec2(here.y + mirrored.y, mirrored.x - here.x);
    imageStore(spectrum, ivec3(frequency, row, channel), vec4(a, 0.0, 0.0));
    imageStore(spectrum, ivec3(frequency, row + 1, channel), vec4(b, 0.0, 0.0));
}

// Called with a constant for each channel: in a loop over channels with barriers, NVIDIA's compiler (580.159) takes the
// last one for all.
void transform(int channel, vec2 left_value, vec2 right_value) {
    int row = int(2 * gl_WorkGroupID.x);
    int left = int(gl_LocalInvocationIndex);
    synchronize();
    values[0][left] = left_value;
    values[0][left + LENGTH / 2] = right_value;
    forward();
    store(left, row, channel);
    if (left == 0) store(LENGTH / 2, row, channel);
}

void main() {
    int row = int(2 * gl_WorkGroupID.x);
    int left = int(gl_LocalInvocationIndex);
    int right = left + LENGTH / 2;
    vec3 a_left = light(ivec2(left, row));
    vec3 b_left = light(ivec2(left, row + 1));
    vec3 a_right = light(ivec2(right, row));
    vec3 b_right = light(ivec2(right, row + 1));
    transform(0, vec2(a_left.r, b_left.r), vec2(a_right.r, b_right.r));
    transform(1, vec2(a_left.g, b_left.g), vec2(a_right.g, b_right.g));
    transform(2, vec2(a_left.b, b_left.b), vec2(a_right.b, b_right.b));
}

#version 450 core

#include "glare_fourier.glsl"

layout(binding = 0, rg32f) uniform readonly image2DArray spectrum;
layout(binding = 1, rgba32f) uniform writeonly image2D glare;
uniform float scale;

// Combines the spectra of two rows a, b to that of a + ib: the inverse of store() in glare_rows.comp.glsl.
void load(int frequency, int row, int channel) {
    vec2 a = imageLoad(spectrum, ivec3(frequency, row, channel)).xy;
    vec2 b = imageLoad(spectrum, ivec3(frequency, row + 1, channel)).xy;
    values[0][reversed(uint((LENGTH - frequency) % LENGTH))] = vec2(a.x + b.y, b.x - a.y);
    values[0][reversed(uint(frequency))] = vec2(a.x - b.y, a.y + b.x);
}

// Writes two rows of one column, without what is outside the image.
void store(int column, int row, vec3 a, vec3 b) {
    if (column >= imageSize(glare).x) return;
    imageStore(glare, ivec2(column, row), vec4(scale * a, 1.0));
    if (row + 1 < imageSize(glare).y) imageStore(glare, ivec2(column, row + 1), vec4(scale * b, 1.0));
}

// Values of both rows at an invocation's left column, and at its right one.
vec4 transformed_back(int channel) {
    int row = int(2 * gl_WorkGroupID.x);
    int left = int(gl_LocalInvocationIndex);
    synchronize();
    load(left, row, channel);
    if (left == 0) load(LENGTH / 2, row, channel);
    inverse();
    return vec4(values[0][left], values[0][left + LENGTH / 2]);
}

void main() {
    int row = int(2 * gl_WorkGroupID.x);
    int left = int(gl_LocalInvocationIndex);
    vec4 red = transformed_back(0);
    vec4 green = transformed_back(1);
    vec4 blue = transformed_back(2);
    store(left, row, vec3(red.x, green.x, blue.x), vec3(red.y, green.y, blue.y));
    store(left + LENGTH / 2, row, vec3(red.z, green.z, blue.z), vec3(red.w, green.w, blue.w));
}

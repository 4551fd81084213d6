#version 450 core

#include "glare_fourier.glsl"

layout(binding = 0, rg32f) uniform readonly image2DArray spectrum;
layout(binding = 1, rgba32f) uniform writeonly image2D glare;
uniform float scale;

// The inverse of glare_rows.comp.glsl's two rows as one.
void load(int frequency, int row, int channel) {
    vec2 a = imageLoad(spectrum, ivec3(frequency, row, channel)).xy;
    vec2 b = imageLoad(spectrum, ivec3(frequency, row + 1, channel)).xy;
    values[0][reversed(uint((LENGTH - frequency) % LENGTH))] = vec2(a.x + b.y, b.x - a.y);
    values[0][reversed(uint(frequency))] = vec2(a.x - b.y, a.y + b.x);
}

// Two rows of one column: as many as the image has.
void store(int column, int row, vec3 a, vec3 b) {
    if (column >= imageSize(glare).x) return;
    imageStore(glare, ivec2(column, row), vec4(scale * a, 1.0));
    if (row + 1 < imageSize(glare).y) imageStore(glare, ivec2(column, row + 1), vec4(scale * b, 1.0));
}

void main() {
    int row = int(2 * gl_WorkGroupID.x);
    int left = int(gl_LocalInvocationIndex);
    int right = left + LENGTH / 2;
    vec3 a_left;
    vec3 b_left;
    vec3 a_right;
    vec3 b_right;
    for (int channel = 0; channel < 3; ++channel) {
        barrier();
        load(left, row, channel);
        if (left == 0) load(LENGTH / 2, row, channel);
        inverse();
        a_left[channel] = values[0][left].x;
        b_left[channel] = values[0][left].y;
        a_right[channel] = values[0][right].x;
        b_right[channel] = values[0][right].y;
    }
    store(left, row, a_left, b_left);
    store(right, row, a_right, b_right);
}

#version 450 core

#include "engine/gpu/shaders/dialect.glsl"
#include "glare_grid.glsl"

layout(location = 0) out vec4 with_glare;

layout(binding = 1) uniform sampler2D glare;
uniform mat3 straight;
uniform bool into_halves;

vec3 interpolated(vec2 position) {
    ivec2 nearest = ivec2(position + 0.5);
    vec3 sum = vec3(0.0);
    for (int y = nearest.y - 1; y <= nearest.y + 1; ++y)
        for (int x = nearest.x - 1; x <= nearest.x + 1; ++x)
            sum += spline(position - vec2(x, y)) * texelFetch(glare, ivec2(x, y), 0).rgb;
    return sum;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 here = texelFetch(scene_linear, pixel, 0);
    vec3 colour = usable(here.rgb);
    vec3 light = bright(colour);
    vec3 sum = colour - light + straight * light + interpolated(position_in_cells(tangents(pixel)));
    with_glare = vec4(usable(sum), here.a);
    if (into_halves) with_glare = rounded_to_half(with_glare);
}

#version 450 core

#include "engine/gpu/shaders/dialect.glsl"

layout(location = 0) out vec4 dimmed;

layout(binding = 0) uniform sampler2D scene_linear;
uniform float tan_half_fov;  // 0: no fall-off by cos⁴
uniform float strength;
uniform float radius;
uniform float softness;
uniform bool into_halves;

// As in vignette.h.
float vignette_factor() {
    vec2 half_size = 0.5 * vec2(textureSize(scene_linear, 0));
    float distance = length(gl_FragCoord.xy - half_size);
    float artistic = 1.0 - strength * smoothstep(radius, radius + softness, distance / length(half_size));
    float tangent = tan_half_fov * distance / half_size.y;
    float squared_secant = 1.0 + tangent * tangent;
    return artistic / (squared_secant * squared_secant);
}

void main() {
    vec4 colour = texelFetch(scene_linear, ivec2(gl_FragCoord.xy), 0);
    dimmed = vec4(vignette_factor() * colour.rgb, colour.a);
    if (into_halves) dimmed = rounded_to_half(dimmed);
}

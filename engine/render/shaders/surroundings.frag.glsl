#version 450 core
// A face of a mirror's surroundings from a picture of its size: engine/render/reflections.h.
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D depth_map;
uniform vec2 planes;   // near, far
uniform int nearness;  // 1: 1 / distance instead of light

layout(location = 0) out vec4 texel;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    float depth = texelFetch(depth_map, at, 0).r;
    texel = vec4(0.0);
    if (depth == 1.0) return;
    float along_axis = planes.x * planes.y / (planes.y - depth * (planes.y - planes.x));
    vec2 across = gl_FragCoord.xy / vec2(textureSize(picture, 0)) * 2.0 - 1.0;
    texel = nearness == 1 ? vec4(inversesqrt(1.0 + dot(across, across)) / along_axis)
                          : vec4(texelFetch(picture, at, 0).rgb, 1.0);
}

#version 450 core
// A face of a mirror's surroundings from a picture of twice its size: engine/render/reflections.h.
layout(binding = 0) uniform sampler2D picture;
layout(binding = 1) uniform sampler2D depth_map;
uniform vec2 planes;   // near, far
uniform int nearness;  // 1: 1 / distance instead of light

layout(location = 0) out vec4 texel;

void main() {
    vec2 size = vec2(textureSize(picture, 0));
    vec4 light = vec4(0.0);
    float nearest = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 at = 2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, i >> 1);
        float depth = texelFetch(depth_map, at, 0).r;
        if (depth == 1.0) continue;
        light += vec4(0.25 * texelFetch(picture, at, 0).rgb, 0.25);
        float along_axis = planes.x * planes.y / (planes.y - depth * (planes.y - planes.x));
        vec2 across = (vec2(at) + 0.5) / size * 2.0 - 1.0;
        nearest = max(nearest, inversesqrt(1.0 + dot(across, across)) / along_axis);
    }
    texel = nearness == 1 ? vec4(nearest) : light;
}

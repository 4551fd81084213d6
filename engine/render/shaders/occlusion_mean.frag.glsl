#version 450 core
// The mean of occlusion.frag.glsl's result over its pattern of 4x4 pixels, of those at a similar depth. Five by five
// pixels whose outer ones count half hold every part of the pattern once, about the middle.
layout(binding = 0) uniform sampler2D visibility_map;

layout(location = 0) out vec4 visibility;

const float SIMILAR = 0.02;  // relative difference of depths at which a pixel counts no more

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(visibility_map, 0) - 1;
    float depth = texelFetch(visibility_map, texel, 0).z;
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int y = -2; y <= 2; ++y)
        for (int x = -2; x <= 2; ++x) {
            vec3 other = texelFetch(visibility_map, clamp(texel + ivec2(x, y), ivec2(0), last), 0).xyz;
            float weight = (abs(x) == 2 ? 0.5 : 1.0) * (abs(y) == 2 ? 0.5 : 1.0) *
                           max(1.0 - abs(other.z - depth) / (SIMILAR * depth), 0.0);
            sum += weight * other.xy;
            weights += weight;
        }
    visibility = vec4(sum / weights, depth, 1.0);
}

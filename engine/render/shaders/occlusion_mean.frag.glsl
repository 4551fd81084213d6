#version 450 core
// The mean of occlusion.frag.glsl's result along one axis, of pixels at a similar depth; a pass along either axis
// removes its pattern of 4x4 pixels. Seven pixels of falling weight contain every part of the pattern equally; with
// four equal weights, thin occluders would show as fans of stripes.
layout(binding = 0) uniform sampler2D visibility_map;
uniform ivec2 axis;

layout(location = 0) out vec4 visibility;

const float SIMILAR = 0.02;  // relative difference of depths from which a pixel has no weight

void main() {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(visibility_map, 0) - 1;
    float depth = texelFetch(visibility_map, texel, 0).z;
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int i = -3; i <= 3; ++i) {
        vec3 other = texelFetch(visibility_map, clamp(texel + i * axis, ivec2(0), last), 0).xyz;
        float weight = float(4 - abs(i)) * max(1.0 - abs(other.z - depth) / (SIMILAR * depth), 0.0);
        sum += weight * other.xy;
        weights += weight;
    }
    visibility = vec4(sum / weights, depth, 1.0);
}

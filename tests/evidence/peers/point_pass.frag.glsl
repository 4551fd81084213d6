#version 450 core
// A peer at points: linear Rec.709. The program defines PEER, the peer's file.
const float PI = 3.14159265358979;
#include "tests/evidence/peers/lights.glsl"
#include PEER

layout(binding = 0) uniform sampler2D views;  // world axes, unit, toward the eye
layout(binding = 1) uniform sampler2D normals;
layout(binding = 2) uniform sampler2D gratings;
layout(location = 0) out vec4 radiance;

void main() {
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec3 g = texelFetch(gratings, at, 0).xyz;
    vec3 n = texelFetch(normals, at, 0).xyz;
    mat3 axes = mat3(g, cross(n, g), n);
    vec3 v = texelFetch(views, at, 0).xyz * axes;
    vec3 sum = vec3(0.0);
    if (v.z > 0.0)
        for (int i = 0; i < peer_lights.length(); ++i) {
            vec3 s = peer_lights[i].direction.xyz * axes;
            if (s.z > 0.0) sum += peer_lights[i].irradiance.rgb * peer_reflection(s, v);
        }
    radiance = vec4(sum, 1.0);
}

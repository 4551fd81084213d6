#version 450 core
#include "engine/render/shaders/scene_blocks.h"

layout(binding = 0) uniform samplerCube environment_map;

in vec3 direction;
layout(location = 0) out vec4 radiance;

// The direction in which the probe's camera captured what the eye sees: a point of a sphere about that camera, or of
// the floor below it.
vec3 from_capture(vec3 seen) {
    vec3 from = eye.xyz - vec3(0.0, dome.x, 0.0);
    float along = dot(from, seen);
    float distance = sqrt(max(along * along - dot(from, from) + dome.y * dome.y, 0.0)) - along;
    if (seen.y < 0.0) distance = min(distance, max(-eye.y / seen.y, 0.0));
    return from + distance * seen;
}

void main() {
    vec3 s = dome.y > 0.0 ? from_capture(normalize(direction)) : direction;
    radiance = vec4(textureLod(environment_map, s, 0.0).rgb * environment.y, 1.0);
    if (shadow.z > 0.0) radiance = rounded_to_half(radiance);
}

#version 450 core
#include "engine/gpu/shaders/half_float.glsl"
#include "engine/render/shaders/frame_block.h"

layout(binding = 0) uniform samplerCube environment_map;

in vec3 direction;
layout(location = 0) out vec4 radiance;

void main() {
    radiance = vec4(textureLod(environment_map, direction, 0.0).rgb * environment.y, 1.0);
    if (shadow.z > 0.0) radiance = rounded_to_half(radiance);
}

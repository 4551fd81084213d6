#version 450 core
#include "engine/render/shaders/object_block.h"

layout(location = 0) out vec4 radiance;

void main() { radiance = vec4(base_colour.xyz, 1.0); }

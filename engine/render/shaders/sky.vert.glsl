#version 450 core
#include "engine/render/shaders/scene_blocks.h"

out vec3 direction;

// One triangle that covers the screen, at the far plane.
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 far = clip_to_world * vec4(corner, 1.0, 1.0);
    direction = far.xyz / far.w;
    gl_Position = vec4(corner, 1.0, 1.0);
}

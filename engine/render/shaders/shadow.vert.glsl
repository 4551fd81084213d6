#version 450 core
#include "engine/render/shaders/vertex_input.glsl"

#ifdef FROM_EYE
#define TO_CLIP view_projection
#else
#define TO_CLIP world_to_shadow
#endif

void main() {
    pass_attributes();
    gl_Position = TO_CLIP * (to_world() * (pose() * vec4(vertex_position, 1.0)));
}

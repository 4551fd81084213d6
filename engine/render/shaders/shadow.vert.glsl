#version 450 core
#include "engine/render/shaders/forward_vertex_interface.glsl"

void main() {
    pass_attributes();
    gl_Position = world_to_shadow * (object_to_world * (pose() * vec4(vertex_position, 1.0)));
}

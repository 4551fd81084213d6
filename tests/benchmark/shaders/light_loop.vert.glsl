#version 450 core
#include "engine/render/shaders/forward_vertex_interface.glsl"

out vec3 world_grating;

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) { world_grating = g; }

#include "engine/render/shaders/forward_vertex_main.glsl"

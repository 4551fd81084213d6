#version 450 core
// The vertex stage of representations that shade pixels and need only the frame from the vertices.
#include "engine/render/shaders/forward_vertex_interface.glsl"
#include "modules/diffraction/shaders/groove_turn.glsl"
#include "modules/diffraction/shaders/vertex_lights.glsl"

out vec3 world_grating;

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
    turn_grooves(g, h);
    shade_lights(position, lit_axes(g, h, n));
    world_grating = g;
}

#include "engine/render/shaders/forward_vertex_main.glsl"

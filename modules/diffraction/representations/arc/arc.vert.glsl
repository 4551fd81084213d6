#version 450 core
// The vertex's part of arc_table.h. The program defines LAYERS.
#include "engine/render/shaders/forward_vertex_interface.glsl"
#include "modules/diffraction/shaders/groove_turn.glsl"
#include "modules/diffraction/shaders/vertex_lights.glsl"

// Red, green and blue (working space) of the products of ranks 4j ... 4j+3, for j < LAYERS; vertex by vertex, from the
// CPU.
STORAGE(4, ArcProducts, vec4, vertex_products);

out vec3 world_grating;
out vec4 arc_products[3 * LAYERS];

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
    turn_grooves(g, h);
    shade_lights(position, lit_axes(g, h, n));
    world_grating = g;
    for (int i = 0; i < 3 * LAYERS; ++i) arc_products[i] = STORED_VEC4(vertex_products, gl_VertexID * 3 * LAYERS + i);
}

#include "engine/render/shaders/forward_vertex_main.glsl"

#version 450 core
// The pixel's part of bake/arc_table.h. LAYERS and VIEW_MAPPING are defined by the program.
#define PIXEL_SHADED
#include "modules/diffraction/shaders/surface.glsl"
#include "modules/diffraction/shaders/packed_table.glsl"

in vec4 arc_products[3 * LAYERS];

vec3 diffracted_xyz(GrooveView view) {
    vec2 coordinates = table_coordinates(view.direction);
    vec3 xyz = vec3(0.0);
    for (int j = 0; j < LAYERS; ++j) {
        vec4 weights = table_entries(coordinates, j);
        xyz += vec3(dot(weights, arc_products[3 * j]), dot(weights, arc_products[3 * j + 1]),
                    dot(weights, arc_products[3 * j + 2]));
    }
    return xyz;
}

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

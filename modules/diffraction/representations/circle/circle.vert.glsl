#version 450 core
// A map for all orientations, at the vertices.
#include "engine/render/shaders/forward_vertex_interface.glsl"
#include "modules/diffraction/representations/circle/circle_map.glsl"

vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    return view.z > 0.0 ? map_radiance(view.x, g, n) : vec3(0.0);
}

#include "modules/diffraction/shaders/vertex_shaded.glsl"
#include "engine/render/shaders/forward_vertex_main.glsl"

#version 450 core
// A flat object's map, at the vertices.
#include "engine/render/shaders/forward_vertex_interface.glsl"
#include "modules/diffraction/representations/planar/planar_map.glsl"

vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    if (view.z <= 0.0) return vec3(0.0);
#ifdef LOBE_MAP
    return map_radiance(view.xy, g);
#else
    return map_radiance(view.x, g, n);
#endif
}

#include "modules/diffraction/shaders/vertex_shaded.glsl"
#include "engine/render/shaders/forward_vertex_main.glsl"

#version 450 core
// The term from the vertices, and analytic lights.
#include "modules/diffraction/shaders/surface.glsl"

in vec3 diffracted;

MaterialTerms material_terms() {
    vec3 xyz = lights_from_vertices_xyz();
#ifdef LIGHTS_AT_PIXELS
    GrooveView view = groove_view();
    if (view.direction.z > 0.0 && view.pitch > 0.0) xyz += direct_xyz(view);
#endif
    return MaterialTerms(base_weight, mirror_weight, diffracted + mat3(xyz_to_working) * xyz);
}

#include "engine/render/shaders/forward_fragment_main.glsl"

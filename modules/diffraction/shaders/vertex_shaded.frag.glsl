#version 450 core
// The term from the vertices, and analytic lights.
#include "modules/diffraction/shaders/surface.glsl"

in vec3 diffracted;

MaterialTerms material_terms() {
    vec3 sum = diffracted;
#if !defined(DIRECTIONAL_LIGHTS) || (defined(SHADOWED_AT_PIXELS) && !defined(SEVERAL_DIRECTIONAL_LIGHTS))
    sum *= ambient_visibility();  // the vertices have added only the probe
#endif
    sum += lights_from_vertices();
#ifdef LIGHTS_AT_PIXELS
    GrooveView view = groove_view();
    if (view.direction.z > 0.0 && view.pitch > 0.0) sum += ambient_visibility() * key_lights_at_pixel(view);
    prepare_lights(view);
#endif
    return surface_terms(sum);
}

#include "engine/render/shaders/forward_fragment_main.glsl"

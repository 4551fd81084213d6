#version 450 core
// What vertices have shaded, and lights of their own.
#include "modules/diffraction/shaders/surface.glsl"

in vec3 diffracted;

MaterialTerms material_terms() {
    vec3 added = diffracted;
#ifdef HAS_DIRECT
    GrooveView view = groove_view();
    if (view.direction.z > 0.0 && view.pitch > 0.0) added += mat3(xyz_to_working) * direct_xyz(view);
#endif
    return MaterialTerms(base_weight, mirror_weight, added);
}

#include "engine/render/shaders/forward_fragment_main.glsl"

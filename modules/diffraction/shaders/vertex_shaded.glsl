// The vertex stage of representations that shade vertices. Before it, the program defines
//   vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n);
// in the working space, of a view in the tangent frame (g, h, n), whose axes are given in the world.
#include "modules/diffraction/shaders/groove_turn.glsl"
#include "modules/diffraction/shaders/has_direct.glsl"
#include "modules/diffraction/shaders/vertex_lights.glsl"

out vec3 diffracted;  // working space
#ifdef LIGHTS_AT_PIXELS
out vec3 world_grating;
#endif

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
    turn_grooves(g, h);
    mat3 axes = lit_axes(g, h, n);
    vec3 view = lit_view_direction(normalize(eye.xyz - position), axes);
    diffracted = diffracted_radiance(view, g, axes[2]) + shade_lights(position, axes);
#ifdef LIGHTS_AT_PIXELS
    world_grating = g;
#endif
}

// The vertex stage of representations that shade vertices. Before it, the program defines
//   vec3 diffracted_xyz(vec3 view);
// of a view in the tangent frame.
#include "modules/diffraction/shaders/groove_turn.glsl"
#include "modules/diffraction/shaders/vertex_lights.glsl"
#include "modules/diffraction/shaders/has_direct.glsl"

out vec3 diffracted;  // working space
#ifdef HAS_DIRECT
out vec3 world_grating;
#endif

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
    turn_grooves(g, h);
    shade_lights(position, g, h, n);
    vec3 v = normalize(eye.xyz - position);
    vec3 view = vec3(dot(v, g), dot(v, h), dot(v, n));
    diffracted = mat3(xyz_to_working) * diffracted_xyz(view);
#ifdef HAS_DIRECT
    world_grating = g;
#endif
}

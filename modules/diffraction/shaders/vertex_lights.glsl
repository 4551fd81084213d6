// Lights of their own that are shaded at the vertices, where the material asks for it: key lights, and directional ones,
// the first apart, as it may throw shadows.
#include "modules/diffraction/shaders/small_light.glsl"
#include "modules/diffraction/shaders/key_lobes.glsl"
#ifdef LIGHTS_AT_VERTICES
#include "engine/render/shaders/light_block.h"

out vec3 key_lights_at_vertex;
#ifdef DIRECTIONAL_LIGHTS
out vec3 first_light_at_vertex;
#endif

void shade_lights(vec3 position, vec3 g, vec3 h, vec3 n) {
    mat3 axes = mat3(g, h, n);
    vec3 direction = normalize(eye.xyz - position) * axes;
    float above = direction.z > 0.0 ? 1.0 : 0.0;
    key_lights_at_vertex = vec3(0.0);
#ifdef KEY_LOBES
    key_lights_at_vertex += above * key_lights_xyz(axes, direction, 0.0);
#endif
#ifdef DIRECTIONAL_LIGHTS
    first_light_at_vertex =
        above * small_light_xyz(lights[0], 1.0, lights[0].place.xyz, axes, direction, kernel_row(0.0), 1.0);
    for (int i = 1; i < int(light_counts.x); ++i)
        key_lights_at_vertex +=
            above * small_light_xyz(lights[i], 1.0, lights[i].place.xyz, axes, direction, kernel_row(0.0), 1.0);
#endif
}
#else
void shade_lights(vec3 position, vec3 g, vec3 h, vec3 n) {}
#endif

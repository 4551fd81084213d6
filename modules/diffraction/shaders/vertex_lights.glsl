// Key lights and directional lights at the vertices, under LIGHTS_AT_VERTICES; the first directional light separately if
// it casts shadows.
#include "modules/diffraction/shaders/has_direct.glsl"
#include "modules/diffraction/shaders/lit_side.glsl"
#ifdef LIGHTS_AT_VERTICES
#include "modules/diffraction/shaders/small_light.glsl"
#include "modules/diffraction/shaders/key_lobes.glsl"
#include "engine/render/shaders/light_block.h"

#ifdef LIGHTS_BESIDE
out vec3 lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
out vec3 shadowed_at_vertex;
#endif

// The sum of the lights without shadows, working space. `axes`: columns g, h, n in the world.
vec3 shade_lights(vec3 position, mat3 axes) {
    vec3 direction = lit_view_direction(normalize(eye.xyz - position), axes);
    vec3 sum = vec3(0.0);
#ifdef KEY_LOBES
    if (direction.z > 0.0) sum = key_lights_radiance(axes, direction, mat2x3(0.0), vec2(0.0));
#endif
#ifdef DIRECTIONAL_LIGHTS
    KernelScale scale = kernel_scale();
    vec3 first = vec3(0.0);
    float weight = small_light_weight(scale, direction.z);
    PixelU u = PixelU(dot(lights[0].position.xyz, axes[0]) + direction.x, 0.0);
    add_small_light(scale, 0, weight, lights[0].position.xyz, axes, direction.y, u, 1.0, first);
#ifdef SHADOWED_AT_PIXELS
    shadowed_at_vertex = kernel_to_working(first);
#else
    sum += first;
#endif
#ifdef SEVERAL_DIRECTIONAL_LIGHTS
    for (int i = 1; i < int(light_counts.x); ++i) {
        u.mean = dot(lights[i].position.xyz, axes[0]) + direction.x;
        add_small_light(scale, i, weight, lights[i].position.xyz, axes, direction.y, u, 1.0, sum);
    }
#endif
#endif
#ifdef LIGHTS_BESIDE
    lights_at_vertex = kernel_to_working(sum);
#endif
    return kernel_to_working(sum);
}
#else
vec3 shade_lights(vec3 position, mat3 axes) { return vec3(0.0); }
#endif

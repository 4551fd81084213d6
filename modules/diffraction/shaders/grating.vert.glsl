#version 450 core
// A grating at a vertex: the frame of its grooves and, as the program's defines say, its part of an arc table, the light
// from the probe (VERTEX_SHADED) and analytic lights (LIGHTS_AT_VERTICES).
#define VERTEX_STAGE
#include "engine/render/shaders/vertex.glsl"
#include "modules/diffraction/shaders/grooves.glsl"

uniform vec2 groove_turn;  // cosine and sine of the surface's groove rotation
out vec3 world_grating;
#ifdef GROOVE_MAP
out float groove_hand;  // sign of a rotation toward the bitangent, for the fragment stage
#endif

// Rotates (g, h) of the mesh's tangent frame by the groove rotation, toward the mesh's bitangent.
void turn_grooves(inout vec3 g, inout vec3 h) {
    // A mirroring transform inverts the cross product.
    float hand = vertex_tangent.w * map_strength.z;
#ifdef SKINNED
    if (determinant(mat3(pose())) < 0.0) hand = -hand;
#endif
#ifdef GROOVE_MAP
    groove_hand = LIT_SIDE * hand;
#endif
    float sine = groove_turn.y * hand;
    vec3 along = g;
    g = groove_turn.x * g + sine * h;
    h = groove_turn.x * h - sine * along;
}

// ---- The light from the probe
#ifdef ARC_PRODUCTS
// Red, green and blue (working space) of the products of ranks 4j ... 4j+3, for j < LAYERS; vertex by vertex, from the
// CPU: arc_table.h.
STORAGE(4, ArcProducts, vec4, vertex_products);
out vec4 arc_products[3 * SHOWN_LAYERS];
#endif
#ifdef VERTEX_SHADED
out vec3 diffracted;  // working space
#endif
#ifdef BANDS
// The light's SH, rotated to each vertex's tangent frame on the CPU. In a buffer texture, since llvmpipe reads each
// float of a storage block vertex by vertex.
const int COEFFICIENTS = BANDS * BANDS;
TEXTURE_UNIT(12) uniform SAMPLER_BUFFER tangent_light;
vec3 light_coefficient(int i) { return BUFFER_TEXEL(tangent_light, gl_VertexID * COEFFICIENTS + i).xyz; }
#endif
#include VERTEX_LIGHT
// The representation's vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n): working space, of a view in the tangent frame
// (g, h, n), whose axes are given in the world.

// ---- Analytic lights
#ifdef LIGHTS_AT_VERTICES
#include "modules/diffraction/shaders/light_blocks.h"
#include "modules/diffraction/shaders/kernel.glsl"
#include KEY_LOBES

#ifdef LIGHTS_FROM_VERTICES
out vec3 lights_at_vertex;
#endif
#ifdef SHADOWED_AT_PIXELS
out vec3 shadowed_at_vertex;  // the first directional light
#endif

// The sum of the lights without shadows, working space. `axes`: columns g, h, n in the world; `direction`: toward the eye.
vec3 vertex_lights(mat3 axes, vec3 direction) {
    vec3 sum = vec3(0.0);
#ifdef KEY_LOBES
    if (direction.z > 0.0) sum = key_lights_radiance(axes, direction, mat2x3(0.0), vec2(0.0));
#endif
#ifdef DIRECTIONAL_LIGHTS
    KernelScale scale = kernel_scale();
    vec3 first = vec3(0.0);
    float weight = small_light_weight(scale, direction.z);
    PixelU u = PixelU(dot(lights[0].position.xyz, axes[0]) + direction.x, 0.0);
    add_small_light(scale, 0, weight, lights[0].position.xyz, lights[0].strength.w, axes, direction.y, u, 1.0, first);
#ifdef SHADOWED_AT_PIXELS
    shadowed_at_vertex = kernel_to_working(first);
#else
    sum += first;
#endif
#ifdef SEVERAL_DIRECTIONAL_LIGHTS
    for (int i = 1; i < int(light_counts.x); ++i) {
        u.mean = dot(lights[i].position.xyz, axes[0]) + direction.x;
        add_small_light(scale, i, weight, lights[i].position.xyz, lights[i].strength.w, axes, direction.y, u, 1.0, sum);
    }
#endif
#endif
    return kernel_to_working(sum);
}
#else
vec3 vertex_lights(mat3 axes, vec3 direction) { return vec3(0.0); }
#endif

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
    turn_grooves(g, h);
    world_grating = g;
    mat3 axes = lit_axes(g, h, n);
    vec3 view = lit_view_direction(normalize(eye.xyz - position), axes);
    vec3 from_lights = vertex_lights(axes, view);
#ifdef LIGHTS_FROM_VERTICES
    lights_at_vertex = from_lights;
#endif
#ifdef ARC_PRODUCTS
    for (int i = 0; i < 3 * SHOWN_LAYERS; ++i)
        arc_products[i] = STORED_VEC4(vertex_products, gl_VertexID * 3 * LAYERS + i);
#endif
#ifdef VERTEX_SHADED
    diffracted = diffracted_radiance(view, g, axes[2]) + from_lights;
#endif
}

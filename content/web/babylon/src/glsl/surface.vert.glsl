// Inserted before main() of Babylon's vertex shader: what grooves.glsl reads from the vertices, in the probe's space.
out vec3 world_position;
out vec3 world_normal;
out vec3 world_grating;
uniform mat3 to_probe;
uniform vec2 groove_turn;  // cosine and sine
#ifdef ROWLAND_ARC
#include "engine/gpu/shaders/dialect.glsl"
STORAGE(4, ArcProducts, vec4, vertex_products);
out vec4 arc_products[3 * LAYERS];
#endif

// `position`, `normal`, `tangent`: in the mesh's space. The grating vector points along the mesh's tangent or away from
// the mesh's origin.
void pass_grooves(vec3 position, vec3 normal, vec4 tangent, mat4 to_world, vec3 normal_in_world) {
    mat3 linear = mat3(to_world);
    world_position = to_probe * (to_world * vec4(position, 1.0)).xyz;
    world_normal = to_probe * normal_in_world;
#ifdef ROWLAND_RADIAL
    vec3 across = position - normal * dot(position, normal);
#else
    vec3 across = tangent.xyz;
#endif
    // A mirroring transform inverts the cross product.
    float hand = determinant(linear) < 0.0 ? -tangent.w : tangent.w;
    vec3 g = linear * across;
    world_grating = to_probe * (groove_turn.x * g + groove_turn.y * hand * cross(normal_in_world, g));
#ifdef ROWLAND_ARC
    for (int i = 0; i < 3 * LAYERS; ++i) arc_products[i] = STORED_VEC4(vertex_products, gl_VertexID * 3 * LAYERS + i);
#endif
}

// What grooves.glsl reads from the vertices, for the vertex stage of an engine.
out vec3 world_position;
out vec3 world_normal;
out vec3 world_grating;
uniform vec2 groove_turn;  // cosine and sine
#ifdef ROWLAND_GROOVE_UV
out vec2 groove_uv;
out float groove_hand;
#endif
#ifdef ROWLAND_ARC
#include "engine/gpu/shaders/dialect.glsl"
STORAGE(4, ArcProducts, vec4, vertex_products);
out vec4 arc_products[3 * LAYERS];
#endif

// `position`, `normal`, `tangent`: in the object's space, which `to_world` leads from; the world is the probe's. The grating
// vector points along the mesh's tangent or away from the object's origin.
void pass_grooves(vec3 position, vec3 normal, vec4 tangent, mat4 to_world, vec3 normal_in_world) {
    world_position = (to_world * vec4(position, 1.0)).xyz;
    world_normal = normal_in_world;
#ifdef ROWLAND_RADIAL
    vec3 across = position - normal * dot(position, normal);
#else
    vec3 across = tangent.xyz;
#endif
    mat3 linear = mat3(to_world);
    // A mirroring transform inverts the cross product.
    float hand = determinant(linear) < 0.0 ? -tangent.w : tangent.w;
    vec3 g = linear * across;
    vec3 h = cross(world_normal, g) * hand;
    world_grating = groove_turn.x * g + groove_turn.y * h;
#ifdef ROWLAND_GROOVE_UV
    groove_uv = ROWLAND_GROOVE_UV;
    groove_hand = hand;
#endif
#ifdef ROWLAND_ARC
    for (int i = 0; i < 3 * LAYERS; ++i) arc_products[i] = STORED_VEC4(vertex_products, gl_VertexID * 3 * LAYERS + i);
#endif
}

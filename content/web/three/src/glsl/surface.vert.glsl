// Inserted after three's <common>: what grooves.glsl reads from the vertices.
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

// `position`, `normal`, `tangent`: in the object's space. The grating vector points along the mesh's tangent or away
// from the object's origin.
void pass_grooves(vec3 position, vec3 normal, vec4 tangent, vec3 normal_in_view) {
    world_position = (modelMatrix * vec4(position, 1.0)).xyz;
    world_normal = normalize((vec4(normal_in_view, 0.0) * viewMatrix).xyz);
#ifdef ROWLAND_RADIAL
    vec3 across = position - normal * dot(position, normal);
#else
    vec3 across = tangent.xyz;
#endif
    mat3 linear = mat3(modelMatrix);
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

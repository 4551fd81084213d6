// Inserted after three's <common> and #define SHOWN_LAYERS: what grooves.glsl reads from the vertices.
out vec3 world_grating;  // in the probe, as all directions of grooves.glsl
uniform vec2 groove_turn;  // cosine and sine
uniform int radial_grooves;
uniform mat3 probe_from_world;
#ifdef ROWLAND_GROOVE_UV
out vec2 groove_uv;
out float groove_hand;
#endif
#ifdef ROWLAND_ARC
#include "engine/gpu/shaders/dialect.glsl"
STORAGE(4, ArcProducts, vec4, vertex_products);
#ifdef USE_BATCHING
STORAGE(6, ArcFirsts, vec4, products_first);
#endif
uniform int products_stride;
out vec4 arc_products[3 * SHOWN_LAYERS];
#endif

// The position and the normal after morphs and before bones, in the object's space.
vec3 groove_position;
vec3 groove_normal;

// g in the object's space before bones: along the tangent, or away from the object's origin. `given`: the normal before morphs.
vec3 grooves_across(vec3 given, vec3 tangent) {
    vec3 n = normalize(groove_normal);
    if (radial_grooves == 1) return groove_position - n * dot(groove_position, n);
#ifdef USE_MORPHNORMALS
    // The least rotation from the given normal to the morphed one.
    vec3 sum = given + n;
    return tangent - sum * (dot(sum, tangent) / max(1.0 + dot(given, n), 1e-6)) + n * (2.0 * dot(given, tangent));
#else
    return tangent;
#endif
}

// `linear`: from the object's space to the world, with bones and instance; `instance`: of vertex_products.
void pass_grooves(vec3 given, vec4 tangent, mat3 linear, vec3 normal_in_view, int instance) {
    vec3 n = normalize((vec4(normal_in_view, 0.0) * viewMatrix).xyz);
    // A mirroring transform inverts the cross product.
    float hand = determinant(linear) < 0.0 ? -tangent.w : tangent.w;
    vec3 g = linear * grooves_across(given, tangent.xyz);
    vec3 h = cross(n, g) * hand;
    world_grating = probe_from_world * (groove_turn.x * g + groove_turn.y * h);
#ifdef ROWLAND_GROOVE_UV
    groove_uv = ROWLAND_GROOVE_UV;
    groove_hand = determinant(probe_from_world) < 0.0 ? -hand : hand;  // of a left-handed world
#endif
#ifdef ROWLAND_ARC
#ifdef USE_BATCHING
    int first = int(STORED_VEC4(products_first, instance).x);
#else
    int first = instance * products_stride;
#endif
    for (int i = 0; i < 3 * SHOWN_LAYERS; ++i)
        arc_products[i] = STORED_VEC4(vertex_products, (first + gl_VertexID) * 3 * LAYERS + i);
#endif
}

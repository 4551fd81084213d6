// Rotates (g, h) of the mesh's tangent frame by the surface's groove rotation, toward the mesh's bitangent.

#include "modules/diffraction/shaders/lit_side.glsl"

uniform vec2 groove_turn;  // cosine and sine
#ifdef GROOVE_MAP
out float groove_hand;  // sign of a rotation toward the bitangent, for the fragment stage
#endif

#ifdef SKINNED
float posed_mirroring() { return determinant(mat3(pose())) < 0.0 ? -1.0 : 1.0; }
#else
float posed_mirroring() { return 1.0; }
#endif

void turn_grooves(inout vec3 g, inout vec3 h) {
    // A mirroring transform inverts the cross product.
    float hand = vertex_tangent.w * map_strength.z * posed_mirroring();
#ifdef GROOVE_MAP
    groove_hand = LIT_SIDE * hand;
#endif
    float sine = groove_turn.y * hand;
    vec3 along = g;
    g = groove_turn.x * g + sine * h;
    h = groove_turn.x * h - sine * along;
}

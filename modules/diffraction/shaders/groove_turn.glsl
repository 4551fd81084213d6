// Turns (g, h) of the mesh's tangent frame by the surface's groove rotation, toward the mesh's bitangent.

uniform vec2 groove_turn;  // cosine and sine

#ifdef SKINNED
float posed_mirroring() { return determinant(mat3(pose())) < 0.0 ? -1.0 : 1.0; }
#else
float posed_mirroring() { return 1.0; }
#endif

void turn_grooves(inout vec3 g, inout vec3 h) {
    // A mirroring transform turns the cross product round.
    float sine = groove_turn.y * vertex_tangent.w * map_strength.z * posed_mirroring();
    vec3 along = g;
    g = groove_turn.x * g + sine * h;
    h = groove_turn.x * h - sine * along;
}

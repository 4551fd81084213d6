// The light's SH, rotated to each vertex's tangent frame on the CPU. RGB after RGB. BANDS is defined by the program.
const int COEFFICIENTS = BANDS * BANDS;

STORAGE(4, TangentLight, float, tangent_light);

vec3 light_coefficient(int i) {
    int at = 3 * (gl_VertexID * COEFFICIENTS + i);
    return vec3(STORED_FLOAT(tangent_light, at), STORED_FLOAT(tangent_light, at + 1), STORED_FLOAT(tangent_light, at + 2));
}

// The light's SH, rotated to each vertex's tangent frame on the CPU. RGB after RGB. BANDS is defined by the program.
const int COEFFICIENTS = BANDS * BANDS;

layout(std430, binding = 4) readonly buffer TangentLight { float tangent_light[]; };

vec3 light_coefficient(int i) {
    int at = 3 * (gl_VertexID * COEFFICIENTS + i);
    return vec3(tangent_light[at], tangent_light[at + 1], tangent_light[at + 2]);
}

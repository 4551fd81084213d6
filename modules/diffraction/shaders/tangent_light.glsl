// The light's SH, rotated to each vertex's tangent frame on the CPU. BANDS is defined by the program. As texels, as llvmpipe
// reads each float of a storage block vertex by vertex.
const int COEFFICIENTS = BANDS * BANDS;

TEXTURE_UNIT(12) uniform SAMPLER_BUFFER tangent_light;

vec3 light_coefficient(int i) { return BUFFER_TEXEL(tangent_light, gl_VertexID * COEFFICIENTS + i).xyz; }

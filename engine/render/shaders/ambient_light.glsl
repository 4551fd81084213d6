// Irradiance / pi from the probe: nine SH terms [Ramamoorthi & Hanrahan 2001], and the key lights if they are apart.
// A material's program that defines AMBIENT_AT_VERTICES has it computed per vertex, where the normal is the mesh's.
#ifdef KEY_LIGHTS
#include "engine/render/shaders/key_light.glsl"
#endif
#if defined(NORMAL_MAP) || defined(DOUBLE_SIDED) || defined(UNLIT)
#undef AMBIENT_AT_VERTICES
#endif

vec3 ambient_light(vec3 n) {
    vec3 sum = 0.282095 * ambient[0].xyz;
    sum += 0.488603 * (n.y * ambient[1].xyz + n.z * ambient[2].xyz + n.x * ambient[3].xyz);
    sum += 1.092548 * (n.x * n.y * ambient[4].xyz + n.y * n.z * ambient[5].xyz + n.x * n.z * ambient[7].xyz);
    sum += 0.315392 * (3.0 * n.z * n.z - 1.0) * ambient[6].xyz;
    sum += 0.546274 * (n.x * n.x - n.y * n.y) * ambient[8].xyz;
#ifdef KEY_LIGHTS
    sum += key_irradiance(n) * 0.31830988618379;
#endif
    return max(sum, 0.0);
}

// A map over g in the world and v_g, Fourier terms of the normal's angle around g: circle_map.h. The program defines
// CHARTS and TERMS. Charts lie side by side, terms below each other. Filtering never reaches a neighbour, as the equator
// lies 1.5 texels inside.
layout(binding = 11) uniform sampler3D circle_map;
uniform float map_scale;  // of the stored values

vec3 map_xyz(float v_g, vec3 g, vec3 n) {
    vec3 size = vec3(textureSize(circle_map, 0));
    float side = size.x / float(CHARTS);
    bool lower = g.y < 0.0;
#if CHARTS == 1
    if (lower) {
        g = -g;
        v_g = -v_g;
    }
    float up = 1.0;
    float chart = 0.0;
#else
    float up = lower ? -1.0 : 1.0;
    float chart = lower ? 1.0 : 0.0;
#endif
    vec3 mirrored = vec3(g.x, up * g.y, g.z);
    float above = 1.0 + mirrored.y;
    vec2 p = 0.5 + mirrored.xz / above * (0.5 - 1.5 / side);
    vec3 e1 = vec3(1.0, 0.0, 0.0) - mirrored.x / above * vec3(mirrored.x, above, mirrored.z);
    vec3 e2 = vec3(0.0, 0.0, 1.0) - mirrored.z / above * vec3(mirrored.x, above, mirrored.z);
    n.y *= up;
    vec2 t1 = vec2(dot(n, e1), dot(n, e2));
    vec2 t2 = vec2(t1.x * t1.x - t1.y * t1.y, 2.0 * t1.x * t1.y);
    vec2 t4 = vec2(t2.x * t2.x - t2.y * t2.y, 2.0 * t2.x * t2.y);
    vec2 t6 = vec2(t4.x * t2.x - t4.y * t2.y, t4.x * t2.y + t4.y * t2.x);
    float factors[9] = float[9](1.0, t1.x, t1.y, t2.x, t2.y, t4.x, t4.y, t6.x, t6.y);
    float r = ((0.5 * v_g + 0.5) * (size.z - 1.0) + 0.5) / size.z;
    vec3 xyz = vec3(0.0);
    for (int term = 0; term < TERMS; ++term)
        xyz += factors[term] *
               textureLod(circle_map, vec3((p.x + chart) / float(CHARTS), (p.y + float(term)) / float(TERMS), r), 0.0).xyz;
    return map_scale * xyz;
}

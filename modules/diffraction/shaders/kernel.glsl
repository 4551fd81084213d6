// d k(d u), the colour kernel smoothed by a normal distribution of u: bake/blurred_kernel.h. One layer for each colour of
// the light.
layout(binding = 10) uniform sampler2DArray kernel_table;
uniform vec4 kernel_place;  // scale and offset from u to s; deviation of u in row 0; scale of the values
uniform vec2 kernel_ends;   // |u| below and above which k is 0
#ifdef ZERO_ORDER
uniform mat3 zero_order;  // RGB in, XYZ out
#endif

// Whether k is other than 0 somewhere within `reach` of u.
bool kernel_reached(float u, float reach) {
    return abs(u) + reach > kernel_ends.x && abs(u) - reach < kernel_ends.y;
}

vec3 kernel_xyz(float u, float deviation, vec3 rgb) {
    float s = u * kernel_place.x + kernel_place.y;
    float wide = max(deviation, kernel_place.z);
    vec3 xyz = vec3(0.0);
    // Most lights miss the orders, so it pays to see that without a look-up.
    if (kernel_reached(u, 5.0 * wide)) {
        float levels = float(textureSize(kernel_table, 0).y);
        float t = (log2(wide / kernel_place.z) * LEVELS_PER_OCTAVE + 0.5) / levels;
        for (int c = 0; c < 3; ++c) xyz += rgb[c] * textureLod(kernel_table, vec3(s, t, c), 0.0).xyz;
        xyz *= kernel_place.w;
    }
#ifdef ZERO_ORDER
    float z = u / wide;
    xyz += zero_order * rgb * (0.39894228040143 * exp(-0.5 * z * z) / wide);
#endif
    return xyz;
}

// d k(d u), the colour kernel smoothed by a normal distribution of u: bake/blurred_kernel.h. Layers for red, green and
// blue light, then one for each colour of the scene's lights. Values are in the colour space of the stored ones.
TEXTURE_UNIT(10) uniform sampler2DArray kernel_table;
uniform vec4 kernel_scale_bias;  // scale and offset from u to s; deviation of u in row 0; scale of the values
uniform vec2 kernel_rows;        // scale and offset from log2(deviation of u) to t
uniform vec2 kernel_reach;       // k is 0 where |u| differs from x by more than y
#ifdef ZERO_ORDER
uniform mat3 zero_order;  // RGB in
#endif

// Whether k is other than 0 somewhere within `reach` of u.
bool kernel_reached(float u, float reach) { return abs(abs(u) - kernel_reach.x) < kernel_reach.y + reach; }

// A deviation's row of the table.
struct KernelRow {
    float wide;
    float t;
};

KernelRow kernel_row(float deviation) {
    float wide = max(deviation, kernel_scale_bias.z);
    return KernelRow(wide, log2(wide) * kernel_rows.x + kernel_rows.y);
}

vec3 kernel_texel(float u, KernelRow row, float layer) {
    return textureLod(kernel_table, vec3(u * kernel_scale_bias.x + kernel_scale_bias.y, row.t, layer), 0.0).xyz;
}

vec3 zero_order_value(float u, float wide, vec3 rgb) {
#ifdef ZERO_ORDER
    float z = u / wide;
    return zero_order * rgb * (0.39894228040143 * exp(-0.5 * z * z) / wide);
#else
    return vec3(0.0);
#endif
}

vec3 kernel_value(float u, float deviation, vec3 rgb) {
    KernelRow row = kernel_row(deviation);
    vec3 value = vec3(0.0);
    // Most lights miss the orders: no look-up is needed for them.
    if (kernel_reached(u, 5.0 * row.wide)) {
        for (int c = 0; c < 3; ++c) value += rgb[c] * kernel_texel(u, row, float(c));
        value *= kernel_scale_bias.w;
    }
    return value + zero_order_value(u, row.wide, rgb);
}

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

// The uniforms, read once before a loop over lights: in it, llvmpipe would read them again for each light.
struct KernelScale {
    vec4 scale_bias;
    vec2 rows;
};

// log2(x) and a constant. In a loop over lights from exponent and mantissa of its bits, within 9e-4, half of what a texture
// unit's weights of 8 bits round off a row: a third of log2()'s cost on llvmpipe.
#if defined(SEVERAL_DIRECTIONAL_LIGHTS) || defined(PUNCTUAL_LIGHTS)
const float LOG2_BIAS = 127.0;
float biased_log2(float x) {
    float line = float(floatBitsToInt(x)) * (1.0 / 8388608.0);
    float m = fract(line);
    return line + (m - m * m) * (0.4228652 - 0.1592199 * m);
}
#else
const float LOG2_BIAS = 0.0;
float biased_log2(float x) { return log2(max(x, 1e-30)); }
#endif

// From biased_log2() of 12 variances of u, the squared width of a box.
KernelScale kernel_scale() {
    const float BIAS = LOG2_BIAS + 3.58496250072116;  // and log2(12)
    return KernelScale(kernel_scale_bias, vec2(0.5 * kernel_rows.x, kernel_rows.y - 0.5 * BIAS * kernel_rows.x));
}

// Of a box of this squared width. It may lie outside the table, which clamps it.
float kernel_row(KernelScale scale, float square_width) {
    return biased_log2(square_width) * scale.rows.x + scale.rows.y;
}

vec3 kernel_texel(KernelScale scale, float u, float t, float layer) {
    return textureLod(kernel_table, vec3(u * scale.scale_bias.x + scale.scale_bias.y, t, layer), 0.0).xyz;
}

vec3 zero_order_value(float u, float deviation, vec3 rgb) {
#ifdef ZERO_ORDER
    float wide = max(deviation, kernel_scale_bias.z);
    float z = u / wide;
    return zero_order * rgb * (0.39894228040143 * exp(-0.5 * z * z) / wide);
#else
    return vec3(0.0);
#endif
}

vec3 kernel_value(float u, float deviation, vec3 rgb) {
    KernelScale scale = kernel_scale();
    float t = kernel_row(scale, 12.0 * deviation * deviation);
    vec3 value = vec3(0.0);
    // Most lights miss the orders: no look-up is needed for them.
    if (kernel_reached(u, 5.0 * max(deviation, scale.scale_bias.z))) {
        for (int c = 0; c < 3; ++c) value += rgb[c] * kernel_texel(scale, u, t, float(c));
        value *= kernel_scale_bias.w;
    }
    return value + zero_order_value(u, deviation, rgb);
}

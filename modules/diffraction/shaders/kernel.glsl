// d k(d u), the colour kernel smoothed by a normal distribution of u: bake/kernel_cells.h. Layers for red, green and
// blue light, then one for each colour of the scene's lights. Values are in the space of kernel_to_working()'s argument.
// KERNEL_VIEWS: k depends on the view, and a layer is a slice for each of some values of view_coordinate().
#ifdef KERNEL_VIEWS
TEXTURE_UNIT(10) uniform sampler3D kernel_table;
uniform vec3 kernel_views;  // factors of the layer and of a view between 0 and 1, and offset, to r
#else
TEXTURE_UNIT(10) uniform sampler2DArray kernel_table;
#endif
uniform vec4 kernel_scale_bias;  // scale and offset from u to s; deviation of u in row 0; scale of the values
uniform vec2 kernel_rows;        // scale and offset from log2(deviation of u) to t
uniform vec2 kernel_reach;       // centre and half-width of the |u| where k is not 0
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

// log2(x) + LOG2_BIAS. In a loop over lights it is computed from the exponent and mantissa of x: error 9e-4, half the
// rounding of 8-bit filter weights; it costs a third of log2() on llvmpipe.
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

// kernel_scale_bias, and kernel_rows for the argument of kernel_row(): 12 variances of u are the squared width of a box.
KernelScale kernel_scale() {
    const float BIAS = LOG2_BIAS + 3.58496250072116;  // and log2(12)
    return KernelScale(kernel_scale_bias, vec2(0.5 * kernel_rows.x, kernel_rows.y - 0.5 * BIAS * kernel_rows.x));
}

// The coordinate t for a box of this squared width. It may lie outside the table, which clamps it.
float kernel_row(KernelScale scale, float square_width) {
    return biased_log2(square_width) * scale.rows.x + scale.rows.y;
}

vec3 kernel_texel(KernelScale scale, float u, float v_g, float t, float layer) {
#ifdef KERNEL_VIEWS
    // (1 + view_coordinate()) / 2, between horizons that lie a little farther apart: no quotient 0 / 0.
    float view = clamp((v_g - 0.5 * u) / (2.0001 - abs(u)) + 0.5, 0.0, 1.0);
    layer = layer * kernel_views.x + view * kernel_views.y + kernel_views.z;
#endif
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

vec3 kernel_value(float u, float v_g, float deviation, vec3 rgb) {
    KernelScale scale = kernel_scale();
    float t = kernel_row(scale, 12.0 * deviation * deviation);
    vec3 value = vec3(0.0);
    // Most lights miss the orders: no look-up is needed for them.
    if (kernel_reached(u, 5.0 * max(deviation, scale.scale_bias.z))) {
        for (int c = 0; c < 3; ++c) value += rgb[c] * kernel_texel(scale, u, v_g, t, float(c));
        value *= kernel_scale_bias.w;
    }
    return value + zero_order_value(u, deviation, rgb);
}

// 2 D_h(s_h + v_h) for X, Y and Z, widened by the light's extent along the grooves: representations/direct/direct.h,
// groove_factor(). The program defines LOBE_GAUSSIAN, LOBE_PITS, LOBE_PIT_SEQUENCE or, for the flat lobe, none of them.

#if defined(LOBE_GAUSSIAN)
uniform vec2 lobe_gaussian;  // deviation; peak of D_h
vec3 groove_factor(float sum_h, float deviation_h) {
    float wide = length(vec2(lobe_gaussian.x, deviation_h));
    float z = sum_h / wide;
    return vec3(2.0 * lobe_gaussian.y * lobe_gaussian.x / wide * exp(-0.5 * z * z));
}
#elif defined(LOBE_PITS)
uniform vec2 lobe_gaussian;   // of the coherent part
uniform vec3 pit_length_over_wavelength;  // for X, Y and Z
uniform float incoherent;     // fraction of the power
// Sum of both parts over nodes at `sum_h`; the weights sum to 2, the factor of 2 D_h. `peak`: of the coherent part.
vec3 pits_factor(vec3 sum_h, vec3 weights, float peak) {
    vec3 z = sum_h / lobe_gaussian.x;
    vec3 factor = vec3(peak * dot(weights, exp(-0.5 * z * z)));
    for (int o = 0; o < 3; ++o) {
        // Nearer to 0 the quotient is 1, to 2e-5; a GPU's sine may have an error of 1e-6.
        vec3 x = max(abs(3.14159265358979 * pit_length_over_wavelength[o] * sum_h), 0.01);
        vec3 amplitude = sin(x) / x;
        factor[o] += incoherent * pit_length_over_wavelength[o] * dot(weights, amplitude * amplitude);
    }
    return factor;
}
// Three-node Gauss-Hermite over the light's extent.
vec3 pits_factor(float sum_h, float deviation_h, float peak) {
    float step = 1.73205080756888 * deviation_h;
    return pits_factor(sum_h + vec3(0.0, -step, step), vec3(4.0, 1.0, 1.0) / 3.0, peak);
}
vec3 groove_factor(float sum_h, float deviation_h) { return pits_factor(sum_h, deviation_h, lobe_gaussian.y); }
vec3 groove_factor(float sum_h) { return pits_factor(vec3(sum_h), vec3(2.0, 0.0, 0.0), lobe_gaussian.y); }
#elif defined(LOBE_PIT_SEQUENCE)
uniform vec2 lobe_gaussian;  // of one order of power 1
uniform vec2 pit_powers;     // of order 0, and of order 1 of one spacing
uniform int pit_spacing_count;
uniform vec4 pit_spacings[LOBE_PIT_SEQUENCE];  // b / wavelength for X, Y and Z
// PHYSICS (3.5): the odd orders within four deviations of `sum_h`.
vec3 groove_factor(float sum_h, float deviation_h) {
    float wide = length(vec2(lobe_gaussian.x, deviation_h));
    float z = abs(sum_h);
    vec3 sum = vec3(pit_powers.x * exp(-0.5 * z * z / (wide * wide)));
    for (int i = 0; i < pit_spacing_count; ++i)
        for (int o = 0; o < 3; ++o) {
            float spacing = pit_spacings[i][o];
            float last = (z + 4.0 * wide) * spacing;
            for (float m = 2.0 * ceil(0.5 * ((z - 4.0 * wide) * spacing - 1.0)) + 1.0; m <= last; m += 2.0) {
                float x = (z - m / spacing) / wide;
                sum[o] += pit_powers.y / (m * m) * exp(-0.5 * x * x);
            }
        }
    return (2.0 * lobe_gaussian.y * lobe_gaussian.x / wide) * sum;
}
#else
vec3 groove_factor(float sum_h, float deviation_h) { return vec3(1.0); }
#endif
#ifndef LOBE_PITS
vec3 groove_factor(float sum_h) { return groove_factor(sum_h, 0.0); }  // of a light without extent
#endif

// The same for the probe's key lights. With a streak, which shows the whole probe, they light the incoherent part alone.
#if defined(STREAK) && defined(LOBE_PITS)
vec3 key_groove_factor(float sum_h, float deviation_h) { return pits_factor(sum_h, deviation_h, 0.0); }
#else
vec3 key_groove_factor(float sum_h, float deviation_h) { return groove_factor(sum_h, deviation_h); }
#endif

// The kernel's values are in the working space; with pits, which have a factor each for X, Y and Z, in XYZ.
vec3 kernel_to_working(vec3 value) {
#if defined(LOBE_PITS) || defined(LOBE_PIT_SEQUENCE)
    return mat3(xyz_to_working) * value;
#else
    return value;
#endif
}

// d k(d u) for a pixel whose pitch d is `pitch_factor` times the material's.
vec3 pitch_kernel_value(float u, float v_g, float deviation, vec3 rgb, float pitch_factor) {
    return pitch_factor * kernel_value(pitch_factor * u, v_g, pitch_factor * deviation, rgb);
}

#ifdef SMALL_LIGHTS
// groove_factor() of a light of this variance along h. The incoherent part of pits is too wide to be widened by it.
#if defined(LOBE_GAUSSIAN) || defined(LOBE_PITS)
vec3 small_light_factor(float sum_h, float variance_h) {
    float narrowing = inversesqrt(1.0 + variance_h / (lobe_gaussian.x * lobe_gaussian.x));
    float z = sum_h * narrowing / lobe_gaussian.x;
    vec3 factor = vec3(2.0 * lobe_gaussian.y * narrowing * exp(-0.5 * z * z));
#ifdef LOBE_PITS
    factor += pits_factor(vec3(sum_h), vec3(2.0, 0.0, 0.0), 0.0);
#endif
    return factor;
}
#elif defined(LOBE_PIT_SEQUENCE)
vec3 small_light_factor(float sum_h, float variance_h) { return groove_factor(sum_h, sqrt(max(variance_h, 0.0))); }
#else
vec3 small_light_factor(float sum_h, float variance_h) { return vec3(1.0); }
#endif

uniform mat3 working_to_rec709;

// Factor of PHYSICS (4.2) on the table's values, ½ of their scale, for a view of this cosine; 0 below the horizon.
float small_light_weight(KernelScale scale, float v_n) { return v_n > 0.0 ? 0.5 * scale.scale_bias.w : 0.0; }

// Adds lights[i]. `weight`: small_light_weight() times irradiance on a surface that faces the light, over its strength;
// `variance`: of its directions across their mean; `axes`: columns g, h, n in the world; `v_h`: toward the eye, along h;
// `u`: of s_g + v_g over the pixel. As the surface sees a disc's upper half better, and directions are shorter toward its
// middle, the mean of s_g is smaller.
void add_small_light(KernelScale scale, int i, float weight, vec3 l, float variance, mat3 axes, float v_h, PixelU u,
                     float pitch_factor, inout vec3 sum) {
    float s_g = dot(l, axes[0]);
    float v_g = u.mean - s_g;
    float shift = variance * s_g;
    u.mean -= 2.0 * shift;
    u.square_width += (variance - shift * s_g) / BOX_VARIANCE;
    float t = kernel_row(scale, pitch_factor * pitch_factor * u.square_width);
    float above = max(dot(l, axes[2]), 0.0);
    float s_h = dot(l, axes[1]);
    vec3 dimmed = (pitch_factor * weight * above * cover_transmittance(above)) *
                  small_light_factor(s_h - 2.0 * variance * s_h + v_h, variance - variance * s_h * s_h);
    // One look-up costs less than a branch around it.
    sum += dimmed * light_layer_scale[i].y * kernel_texel(scale, pitch_factor * u.mean, v_g, t, light_layer_scale[i].x);
#ifdef ZERO_ORDER
    sum += dimmed / scale.scale_bias.w *
           zero_order_value(pitch_factor * u.mean, pitch_factor * deviation_of(u),
                            working_to_rec709 * lights[i].strength.rgb);
#endif
}
#endif

#ifdef KEY_LOBES
// Cumulative normal distribution [Press et al., Numerical Recipes, erfcc: 1.2e-7 relative].
float normal_cdf(float x) {
    float z = abs(x) * 0.70710678118655;
    float t = 1.0 / (1.0 + 0.5 * z);
    float p = -1.13520398 + t * (1.48851587 + t * (-0.82215223 + t * 0.17087277));
    p = 0.09678418 + t * (-0.18628806 + t * (0.27886807 + t * p));
    p = -1.26551223 + t * (1.00002368 + t * (0.37409196 + t * p));
    float beyond = 0.5 * t * exp(p - z * z);
    return x < 0.0 ? beyond : 1.0 - beyond;
}

float normal_density(float x) { return 0.39894228040143 * exp(-0.5 * x * x); }

// Mean of max(0, x) for x of this mean and deviation: engine/lighting/key_lights.h, clamp_normal(). What exceeds
// max(0, mean) is the deviation times a function of |z|, fitted as 2 to the power of a polynomial: 7e-7 of the deviation.
float clamped_mean(float mean, float deviation) {
    float z = min(abs(mean) / max(deviation, 1e-12), 8.0);
    float power = -1.3257504 + z * (-1.8080855 + z * (-0.4119510 + z * (-0.0426687 + z * 0.0031916)));
    return max(mean, 0.0) + deviation * exp2(power);
}

// Mean and variance of x above 0, values weighted by x, for x of this mean and variance; 0 where nothing is above:
// engine/lighting/key_lights.h, clamp_normal().
struct ClampedMoments {
    float weighted_mean;
    float weighted_variance;
};
ClampedMoments clamped_moments(float mean, float variance) {
    float deviation = sqrt(variance);
    float above = normal_cdf(mean / deviation);  // P(x > 0)
    float density = deviation * normal_density(mean / deviation);
    float first = mean * above + density;
    if (!(first > 1e-6 * deviation)) return ClampedMoments(0.0, 0.0);
    float weighted = ((mean * mean + variance) * above + mean * density) / first;
    float third = mean * (mean * mean + 3.0 * variance) * above + (mean * mean + 2.0 * variance) * density;
    return ClampedMoments(weighted, max(third / first - weighted * weighted, 0.0));
}

// Mean of a cover's transmittance over a lobe: direct.h, transmittance(). `mean_n`: mean of s_n; `moments`: of KeyLobe
// (light_blocks.h).
float lobe_transmittance(float mean_n, vec4 moments) {
#ifdef COVER
    ClampedMoments above = clamped_moments(mean_n, max(moments.y * mean_n * mean_n + moments.z, 0.0));
    float deviation = sqrt(above.weighted_variance);
    return 0.5 * (cover_transmittance(above.weighted_mean - deviation) +
                  cover_transmittance(min(above.weighted_mean + deviation, 1.0)));
#else
    return 1.0;
#endif
}

#if defined(LOBE_GAUSSIAN) || defined(LOBE_PITS) || defined(LOBE_PIT_SEQUENCE)
// Mean and deviation of s_h, directions weighted by s_n above the horizon: direct.cpp, clamp_at_horizon(). `mean`: of the
// lobe's directions, in (g, h, n); `moments`: of KeyLobe.
vec2 spread_along_grooves(vec3 mean, vec4 moments) {
    float elongation = moments.y;
    float variance_n = max(elongation * mean.z * mean.z + moments.z, 0.0);
    float variance_h = elongation * mean.y * mean.y + moments.z;
    ClampedMoments above = clamped_moments(mean.z, variance_n);
    if (above.weighted_mean == 0.0) return vec2(mean.y, sqrt(max(variance_h, 0.0)));
    float slope = elongation * mean.y * mean.z / variance_n;
    float uncorrelated = max(variance_h - slope * slope * variance_n, 0.0);
    return vec2(mean.y + slope * (above.weighted_mean - mean.z),
                sqrt(uncorrelated + slope * slope * above.weighted_variance));
}
#else
vec2 spread_along_grooves(vec3 mean, vec4 moments) { return vec2(0.0); }
#endif
#endif

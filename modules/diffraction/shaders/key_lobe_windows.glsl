// The probe's key lights on a grating as the CPU shades them, without tables: representations/direct/lobe_cosine.h.
#include "modules/diffraction/shaders/light_spot.glsl"
#include "modules/diffraction/shaders/small_light.glsl"
#if defined(KEY_LOBES) && defined(KEY_LOBE_WINDOWS)

// Integral of sin t e^(z (cos(t - t0) - 1)) over t in (0, pi), sine and cosine those of t0.
float light_above_wide(float sine, float cosine, float z) {
    const vec3 HEIGHTS = vec3(0.14683948, 0.66311352, 1.0);  // Gauss-Legendre, five nodes
    const vec3 ALONG = vec3(0.98916033, 0.74851884, 0.0);
    const vec3 WEIGHTS = vec3(0.37216388, 0.75182816, 0.89360858);
    float sum = WEIGHTS.z * exp(z * (sine - 1.0));
    for (int i = 0; i < 2; ++i) {
        float middle = HEIGHTS[i] * sine - 1.0;
        float side = ALONG[i] * cosine;
        sum += WEIGHTS[i] * HEIGHTS[i] * (exp(z * (middle + side)) + exp(z * (middle - side)));
    }
    return sum;
}

// The same, exact in the tails also: `cosine` not negative, z >= 3.
float light_above_narrow(float sine, float cosine, float z) {
    float root = sqrt(z);
    float begin = -sine * sqrt(2.0 / (1.0 + cosine)) * root;  // 2 - 2 cos cancels at the horizon
    float end = sqrt(2.0 + 2.0 * cosine) * root;
    float above = begin > 0.0 ? normal_cdf(-begin) - normal_cdf(-end) : normal_cdf(end) - normal_cdf(begin);
    float at_begin = exp(-0.5 * begin * begin);
    float at_end = exp(-0.5 * end * end);
    float second = 0.375 / z;
    float even = (2.50662827463100 * above * (1.0 - second) + second * (end * at_end - begin * at_begin)) / root;
    return cosine * (at_begin - at_end) / z + sine * even;
}

const float NO_LIGHT = -1e30;

// Logarithm of a lobe's light at an angle `d` from its psi, s_g = sin psi, without the factors that do not depend on d and
// without its normal distribution. `axis`: the lobe's direction in (g, h, n); `across`: of it.
float log_light(float concentration, vec3 axis, float across, float d) {
    float cosine = across * cos(d) - axis.x * sin(d);
    if (cosine < 1e-4) return NO_LIGHT;
    float z = concentration * cosine * across;
    float height = axis.z / across;
    float side = abs(axis.y) / across;
    float above = z < 3.0 ? light_above_wide(height, side, z) : light_above_narrow(height, side, z);
    if (above < 1e-20) return NO_LIGHT;
    float square = d * d;
    // -2 sin^2(d/2) + d^2/2
    float beyond_normal = square * square * (1.0 / 24.0 - square * (1.0 / 720.0));
    return 2.0 * log(cosine) + concentration * beyond_normal + log(above);
}

// The normal distribution of psi is a sum of narrower ones at equal steps. The lobe's other factors are normal in each,
// from their logarithms at its neighbours: slope and curvature.
vec3 key_lobe_radiance(KeyLobe lobe, GrooveView view) {
    const int SIDE = 6;           // windows on either side of the middle
    const float WITHIN = 0.1;     // a window's part of the variance
    const float STEP = 0.505964;  // 1.6 deviations of a window, in the lobe's
    PixelU u = pixel_u(view, lobe.direction.xyz);
    vec3 axis = to_tangent(view, lobe.direction.xyz);
    vec3 mean = lobe.moments.x * axis;
    // Five deviations below the horizon, 5e-8 of the lobe's cosine remains.
    if (mean.z < -lobe.moments.w) return vec3(0.0);
#ifndef ZERO_ORDER
    float reach = view.pitch * (5.2 * sqrt(lobe.moments.z) + 5.0 * deviation_of(u)) + 5.0 * kernel_scale_bias.z;
    if (!kernel_reached(view.pitch * u.mean, reach)) return vec3(0.0);
#endif
    axis.x = clamp(axis.x, -1.0, 1.0);
    float across = max(length(axis.yz), 1e-6);
    float concentration = lobe.direction.w;
    float variance = WITHIN / concentration;
    float step = STEP * inversesqrt(concentration);
    vec3 sum = vec3(0.0);
    float before = NO_LIGHT;
    float here = log_light(concentration, axis, across, -float(SIDE + 1) * step);
    float after = log_light(concentration, axis, across, -float(SIDE) * step);
    for (int i = -SIDE; i <= SIDE; ++i) {
        float d = float(i) * step;
        before = here;
        here = after;
        after = log_light(concentration, axis, across, d + step);
        if (here == NO_LIGHT) continue;
        bool ends = before == NO_LIGHT || after == NO_LIGHT;
        float rise = after == NO_LIGHT ? 0.0 : after - here;
        float fall = before == NO_LIGHT ? 0.0 : here - before;
        float slope = (rise + fall) / (ends ? step : 2.0 * step);
        float curvature = ends ? 0.0 : (rise - fall) / (step * step);
        float narrowing = clamp(1.0 - curvature * variance, 0.5, 2.0);
        float within = variance / narrowing;
        float shift = clamp(slope * within, -1.5 * sqrt(variance), 1.5 * sqrt(variance));
        float growth = min(0.5 * slope * slope * within, 1.2);
        float x = d * d * concentration;
        float light = exp(here + growth - 0.5 / (1.0 - WITHIN) * x) * inversesqrt(narrowing);
        // Mean and variance of sin psi, less those of the middle, without cancellation.
        float turn = d + shift;
        float sine = axis.x * cos(turn) + across * sin(turn);
        float cosine = across * cos(turn) - axis.x * sin(turn);
        float half_within = 0.5 * within;
        float less = within * (1.0 - half_within * (1.0 - within * (1.0 / 3.0)));  // 1 - exp(-within)
        float square = 0.5 * less * (less + 2.0 * (1.0 - less) * cosine * cosine);
        float centre = sine * (1.0 - half_within * (1.0 - 0.5 * half_within));
        sum += light * pitch_kernel_value(u.mean + (centre - axis.x), sqrt(square + BOX_VARIANCE * u.square_width),
                                          lobe.flux.rgb, view.pitch);
    }
    // Of the windows and, for concentrations of 3 and more, of the lobe's density.
    float scale = STEP / sqrt(1.0 - WITHIN) * sqrt(concentration) / 6.28318530717959;
    vec2 along = spread_along_grooves(mean, lobe.moments);
    return 0.5 * scale * lobe_transmittance(mean.z, lobe.moments) *
           key_groove_factor(along.x + view.direction.y, along.y) * sum;
}

vec3 key_lights_radiance(GrooveView view) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) sum += key_lobe_radiance(key_lobes[i], view);
    return sum;
}

#endif

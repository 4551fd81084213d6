// The probe's key lights on a grating without tables, as the CPU shades them: representations/direct/lobe_table.h,
// LobeCosine.

// The light above the horizon, A(z) = integral of sin t e^(z (cos(t - t0) - 1)) over t in (0, pi), over
// z = concentration cos psi0 cos psi. log2(A) without its decay below the horizon is approximated by a cubic in
// log2(1 + z) from value and slope at z = 0 and at another z, and linearly beyond.
struct LightAbove {
    float decay;  // of log2(A), over z
    float at;     // log2(1 + z) there
    vec4 powers;  // of log2(1 + z) less that
};

// A and z/A dA/dz for z < 3; `sine` and `cosine` of t0, the latter not negative.
vec2 light_above_wide(float sine, float cosine, float z) {
    const vec3 HEIGHTS = vec3(0.14683948, 0.66311352, 1.0);  // Gauss-Legendre, five nodes
    const vec3 ALONG = vec3(0.98916033, 0.74851884, 0.0);
    const vec3 WEIGHTS = vec3(0.37216388, 0.75182816, 0.89360858);
    float sum = WEIGHTS.z * exp(z * (sine - 1.0));
    float change = (sine - 1.0) * sum;
    for (int i = 0; i < 2; ++i) {
        vec2 power = HEIGHTS[i] * sine - 1.0 + ALONG[i] * cosine * vec2(1.0, -1.0);
        vec2 light = WEIGHTS[i] * HEIGHTS[i] * exp(z * power);
        sum += light.x + light.y;
        change += dot(power, light);
    }
    return vec2(sum, z * change / sum);
}

// The same for z >= 3, in the tails also: with tau = t - t0 the part in sin(tau) has a closed integral, the other is
// normal in 2 sqrt(z) sin(tau/2) from -middle on, to 1/z^2.
vec2 light_above_narrow(float sine, float cosine, float z) {
    float half_cosine = sqrt(0.5 + 0.5 * cosine);
    float root = sqrt(z);
    float middle = sine * root / half_cosine;
    float end = 2.0 * half_cosine * root;
    float at_begin = exp(-0.5 * middle * middle);
    float at_end = exp(-0.5 * end * end);
    float second = 0.375 / z;
    float even = (1.0 - second) * half_cosine;
    float normal = 2.50662827463100 * clamped_mean(middle, 1.0) - at_begin;
    float sum = cosine * (at_begin - at_end) + even * normal +
                root * sine * (second * (end * at_end + middle * at_begin) -
                               (1.0 - second) * at_end * end / (end * end + 1.0));
    float change = (0.5 * even + second * half_cosine) * normal - 0.5 * (cosine - even) * middle * middle * at_begin;
    return vec2(sum / z, change / sum - 1.0);
}

LightAbove light_above(float sine, float cosine, float z) {
    float decay = sine < 0.0 ? sine * sine / (1.0 + cosine) : 0.0;
    z = min(z, 1.5 / max(decay, 1e-6));  // beyond, little light is left and its slope is uncertain
    vec2 light = z < 3.0 ? light_above_wide(sine, cosine, z) : light_above_narrow(sine, cosine, z);
    float at = max(log2(1.0 + z), 1e-3);
    float value = log2(max(light.x, 1e-30)) + 1.44269504 * decay * z;
    float slope = (light.y + decay * z) * (1.0 + z) / z;
    float first_slope = 0.785398163 * sine - 1.0 + decay;
    float rest = (1.0 - value) / at + slope;  // A = 2 at z = 0
    float third = (first_slope - slope + 2.0 * rest) / at;
    return LightAbove(1.44269504 * decay, at, vec4(value, slope, rest / at + third, third / at));
}

const float NO_LIGHT = -1e30;

// log2 of a lobe's light where cos psi = `cosine`, `z` = concentration cos psi0 cos psi, over the normal distribution of
// psi, of this variance. `d`: from the middle, in deviations.
float log_light(LightAbove above, float cosine, float z, float variance, float d) {
    float far = log2(1.0 + z) - above.at;
    float light = above.powers.x + far * (above.powers.y + min(far, 0.0) * (above.powers.z + far * above.powers.w));
    // -2 sin^2(d/2) + d^2/2 of the angle, over the variance
    float square = d * d;
    float beyond_normal = 1.44269504 * variance * square * square * (1.0 / 24.0 - variance * square * (1.0 / 720.0));
    return cosine < 1e-4 ? NO_LIGHT : 2.0 * log2(cosine) + min(light, 1.0) - above.decay * z + beyond_normal;
}

// The normal distribution of psi is a sum of narrower ones at equal steps. The lobe's other factors are normal in each,
// from their logarithms at its neighbours: slope and curvature. Lengths are in deviations of the lobe, but those of u.
vec3 key_lobe_radiance(KeyLobe lobe, GrooveView view) {
    const float STEP = ROWLAND_LOBE_WINDOW_STEP;  // 1.6 deviations of a window
    const float WITHIN = 0.1;                     // a window's part of the variance
    const float LN2 = 0.69314718;
    PixelU u = pixel_u(view, lobe.direction.xyz);
    vec3 axis = to_tangent(view, lobe.direction.xyz);
    vec3 mean = lobe.moments.x * axis;
    // Five deviations below the horizon, 5e-8 of the lobe's cosine remains.
    if (mean.z < -lobe.moments.w) return vec3(0.0);
#ifndef ZERO_ORDER
    float reach = view.pitch * (lobe.moments.w + 5.0 * deviation_of(u)) + 5.0 * kernel_scale_bias.z;
    if (!kernel_reached(view.pitch * u.mean, reach)) return vec3(0.0);
#endif
    axis.x = clamp(axis.x, -1.0, 1.0);
    float across = max(length(axis.yz), 1e-6);
    float z = lobe.direction.w * across;
    float deviation = inversesqrt(lobe.direction.w);
    float variance = deviation * deviation;
    // Half a deviation from the middle, away from g: where the lobe surrounds g, most of its light is there. For a
    // lobe below the horizon, from the nearest point of the horizon.
    vec2 nearest = vec2(axis.z < 0.0 ? max(abs(axis.y), 1e-6) : across, abs(axis.x));
    nearest *= inversesqrt(dot(nearest, nearest));
    LightAbove above = light_above(axis.z / across, abs(axis.y) / across,
                                   0.5 * z * dot(nearest, vec2(1.0 + lobe.turns.x, lobe.turns.y)));
    // Cosine and sine of psi in a window and in the next one.
    vec2 step = lobe.turns.zw;
    vec2 next = vec2(across, axis.x) * lobe.variance.z + vec2(axis.x, -across) * lobe.variance.w;
    vec2 psi = next * step.x + vec2(next.y, -next.x) * step.y;
    float before = NO_LIGHT;
    float here = log_light(above, psi.x, z * psi.x, variance, float(ROWLAND_LOBE_WINDOWS + 1) * STEP);
    float after = log_light(above, next.x, z * next.x, variance, float(ROWLAND_LOBE_WINDOWS) * STEP);
    KernelScale scale = kernel_scale();
    float from = u.mean - axis.x;

    float widest = sqrt(2.0 * WITHIN * variance + BOX_VARIANCE * u.square_width);
    float beyond = 5.0 * (view.pitch * widest + scale.scale_bias.z);
    mat3 sums = mat3(0.0);  // of red, green and blue light
    vec3 zero = vec3(0.0);
    for (int i = -ROWLAND_LOBE_WINDOWS; i <= ROWLAND_LOBE_WINDOWS; ++i) {
        float d = float(i) * STEP;
        psi = next;
        next = psi * step.x + vec2(-psi.y, psi.x) * step.y;
        before = here;
        here = after;
        after = log_light(above, next.x, z * next.x, variance, d + STEP);
        if (here == NO_LIGHT) continue;
        float rise = after - here;
        float fall = here - before;
        if (after == NO_LIGHT) rise = fall;
        if (before == NO_LIGHT) fall = rise;
        float narrowing = clamp(1.0 - (rise - fall) * (WITHIN * LN2 / (STEP * STEP)), 0.5, 2.0);
        float narrower = inversesqrt(narrowing);
        float within = WITHIN * narrower * narrower;
        float slope = 0.5 / STEP * (rise + fall);  // of log2
        float shift = clamp(LN2 * slope * within, -1.5 * sqrt(WITHIN), 1.5 * sqrt(WITHIN));
        float growth = min(0.5 * LN2 * slope * slope * within, 1.7);
        float light = exp2(here + growth - 0.5 / (LN2 * (1.0 - WITHIN)) * d * d) * narrower;
        // Mean and variance of sin psi.
        shift *= deviation;
        within *= variance;
        float turned = 1.0 - 0.5 * shift * shift;
        float sine = psi.y * turned + psi.x * shift;
        float cosine = psi.x * turned - psi.y * shift;
        float square = within * (cosine * cosine * (1.0 - 1.5 * within) + 0.5 * within);
        float centre = view.pitch * (from + sine * (1.0 - 0.5 * within));
        float square_width = view.pitch * view.pitch * (square / BOX_VARIANCE + u.square_width);
#ifdef ZERO_ORDER
        zero += light * zero_order_value(centre, sqrt(BOX_VARIANCE * square_width), lobe.flux.rgb);
#endif
        if (!kernel_reached(centre, beyond)) continue;
        float row = kernel_row(scale, square_width);
        for (int c = 0; c < 3; ++c) sums[c] += light * kernel_texel(scale, centre, from, row, float(c));
    }
    // The norm of the windows and, for concentrations of 3 and more, of the lobe's density.
    float norm = STEP / sqrt(1.0 - WITHIN) / (deviation * 6.28318530717959);
    vec2 along = spread_along_grooves(mean, lobe.moments);
    return 0.5 * norm * view.pitch * lobe_transmittance(mean.z, lobe.moments) *
           key_groove_factor(along.x + view.direction.y, along.y) *
           (scale.scale_bias.w * (sums * lobe.flux.rgb) + zero);
}

vec3 key_lights_radiance(GrooveView view) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < int(key_lobe_count.x); ++i) sum += key_lobe_radiance(key_lobes[i], view);
    return sum;
}

// Working space.
vec3 key_lights_at_pixel(GrooveView view) { return kernel_to_working(key_lights_radiance(view)); }

// A light in a surface's tangent frame: representations/direct/direct.h, light_spot().
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef KEY_LOBES
#include "modules/diffraction/shaders/cover.glsl"
#include "modules/diffraction/shaders/key_lobe_block.h"
#include "modules/diffraction/shaders/normal_distribution.glsl"

// A part of a light as a normal distribution in s_g.
struct LightPart {
    float cosine;  // mean of s_n above the horizon
    float centre;
    float deviation;
};

// Mean of max(0, sin t) for t from a von Mises distribution about t0: direct.h, mean_above_wide(). The form of the variance
// avoids cancellation for narrow lobes.
float mean_above(float sine, float concentration) {
    float root = sqrt(concentration * concentration + 2.25);
    float ratio = concentration / (0.5 + root);
    float one_less_ratio = (0.5 + 2.25 / (root + concentration)) / (0.5 + root);
    float one_less_second = 2.0 / (0.5 + root);
    float variance = 0.5 * one_less_second + sine * sine * (one_less_ratio * (1.0 + ratio) - one_less_second);
    return clamped_mean(ratio * sine, sqrt(max(variance, 0.0)));
}

// Part 0: the middle of the lobe; 1 and 2: its sides. `axis`: its direction in (g, h, n). The caller divides by the sum of
// the `weight`s.
LightPart lobe_part(KeyLobe lobe, vec3 axis, float across, int part, out float weight) {
    const float SKEW = 1.0 + 0.7 / 0.6;
    float side = part == 0 ? 0.0 : part == 1 ? lobe.nodes.y : -lobe.nodes.y;
    float middle = part == 0 ? 1.0 : lobe.nodes.x;
    // The angle psi from the plane across g: sin psi = s_g.
    float cosine = across * middle - axis.x * side;
    float sine = axis.x * middle + across * side;
    weight = 0.0;
    if (cosine <= 0.0) return LightPart(0.0, 0.0, 0.0);
    weight = (part == 0 ? 2.0 / 3.0 : 1.0 / 6.0) * sqrt(cosine);
    float variance = lobe.nodes.z;
    float deviation = sqrt(variance);
    float shift = -1.5 * variance * sine / cosine;
    float above = mean_above(axis.z / across, lobe.direction.w * cosine * across);
    shift = clamp(shift, -deviation, deviation);
    return LightPart(weight * cosine * above,
                     (sine * cos(shift) + cosine * sin(shift)) * lobe.nodes.w,
                     deviation * across * min(pow(cosine / across, SKEW), 2.0));
}

// Mean and variance of x above 0, values weighted by x, for x of this mean and variance; 0 where nothing is above:
// engine/lighting/key_lights.h, clamp_normal().
struct ClampedMoments {
    float weighted_mean;
    float weighted_variance;
};
ClampedMoments clamped_moments(float mean, float variance) {
    float deviation = sqrt(variance);
    float below = normal_cdf(mean / deviation);
    float density = deviation * normal_density(mean / deviation);
    float first = mean * below + density;
    if (!(first > 1e-6 * deviation)) return ClampedMoments(0.0, 0.0);
    float weighted = ((mean * mean + variance) * below + mean * density) / first;
    float third = mean * (mean * mean + 3.0 * variance) * below + (mean * mean + 2.0 * variance) * density;
    return ClampedMoments(weighted, max(third / first - weighted * weighted, 0.0));
}

// Mean of a cover's transmittance over a lobe: direct.h, transmittance(). `mean_n`: mean of s_n.
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

#if defined(LOBE_GAUSSIAN) || defined(LOBE_PITS)
// Mean and deviation of s_h, directions weighted by s_n above the horizon: direct.cpp, clamp_at_horizon(). `mean`: of the
// lobe's directions, in (g, h, n).
vec2 spread_along_grooves(vec3 mean, vec4 moments) {
    float elongation = moments.y;
    float variance_n = max(elongation * mean.z * mean.z + moments.z, 0.0);
    float variance_h = elongation * mean.y * mean.y + moments.z;
    ClampedMoments above = clamped_moments(mean.z, variance_n);
    if (above.weighted_mean == 0.0) return vec2(mean.y, sqrt(max(variance_h, 0.0)));
    float slope = elongation * mean.y * mean.z / variance_n;
    float rest = max(variance_h - slope * slope * variance_n, 0.0);
    return vec2(mean.y + slope * (above.weighted_mean - mean.z),
                sqrt(rest + slope * slope * above.weighted_variance));
}
#else
vec2 spread_along_grooves(vec3 mean, vec4 moments) { return vec2(0.0); }
#endif
#endif

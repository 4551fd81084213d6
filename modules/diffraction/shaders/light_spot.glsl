// A light in a surface's tangent frame: representations/direct/direct.h, light_spot().
#include "modules/diffraction/shaders/has_direct.glsl"
#ifdef KEY_LOBES
#include "modules/diffraction/shaders/cover.glsl"
#include "modules/diffraction/shaders/key_lobe_block.h"
#include "modules/diffraction/shaders/normal_distribution.glsl"

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

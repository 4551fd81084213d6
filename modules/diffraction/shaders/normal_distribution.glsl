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

// Mean of max(0, x) for x of this mean and deviation: engine/lighting/key_lights.h, clamp_normal().
float clamped_mean(float mean, float deviation) {
    if (mean < -12.0 * deviation) return 0.0;
    if (deviation <= 0.0) return mean;
    float z = mean / deviation;
    return max(mean * normal_cdf(z) + deviation * normal_density(z), 0.0);
}

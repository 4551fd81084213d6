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

// The Fejér ratio F_N(m + δ) at distance delta from any whole order m, as model/fejer.h: 1 at δ = 0, never above.
// The order is no parameter: adding it would round δ away, which near a peak costs up to 230 in float.

// sin(πx) for |x| ≤ ½, 1e-7 relative. Not the GPU's own sine, whose error near 0 may be 1e-6 absolute: two such are
// divided by each other below.
float fejer_sin_pi(float x) {
    float y = 3.14159265358979 * x;
    float s = y * y;
    return y * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0)))));
}

// grooves: a whole number N ≥ 1. 1e-5 absolute.
float fejer(float grooves, float delta) {
    float period_delta = delta - roundEven(delta);
    float phase = grooves * period_delta;
    if (abs(phase) < 1e-4) {
        // Series about the peak: 1 − (N²−1)(πδ)²/3, whose next term is under 1e-14.
        float x = 3.14159265358979 * period_delta;
        return 1.0 - (grooves - 1.0) * x * ((grooves + 1.0) * x) / 3.0;
    }
    // The product's rounding is lost here, but it is 6e-8 of N·δ, and N sin(πδ) below is as large as N·δ or larger.
    float ratio = fejer_sin_pi(phase - roundEven(phase)) / (grooves * fejer_sin_pi(period_delta));
    return ratio * ratio;
}

// 2 D_h(s_h + v_h) for X, Y and Z, widened by the light's extent along the grooves: representations/direct/direct.h,
// groove_factor(). The program defines LOBE_GAUSSIAN, LOBE_PITS or, for the flat lobe, neither.

#if defined(LOBE_GAUSSIAN)
uniform vec2 lobe_gaussian;  // deviation; peak of D_h
vec3 groove_factor(float sum_h, float deviation_h) {
    float wide = length(vec2(lobe_gaussian.x, deviation_h));
    float z = sum_h / wide;
    return vec3(2.0 * lobe_gaussian.y * lobe_gaussian.x / wide * exp(-0.5 * z * z));
}
#elif defined(LOBE_PITS)
uniform vec2 lobe_gaussian;   // of the coherent part
uniform vec3 pit_wavelengths;  // pits' length over the wavelength, for X, Y and Z
uniform float incoherent;     // fraction of the power
// Means of the two parts over nodes at `sum_h` with these weights. `peak`: of the coherent part.
vec3 pits_factor(vec3 sum_h, vec3 weights, float peak) {
    vec3 z = sum_h / lobe_gaussian.x;
    vec3 factor = vec3(peak * dot(weights, exp(-0.5 * z * z)));
    for (int o = 0; o < 3; ++o) {
        // Nearer to 0 the quotient is 1, to 2e-5; a GPU's sine may have an error of 1e-6.
        vec3 x = max(abs(3.14159265358979 * pit_wavelengths[o] * sum_h), 0.01);
        vec3 amplitude = sin(x) / x;
        factor[o] += incoherent * pit_wavelengths[o] * dot(weights, amplitude * amplitude);
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
#ifdef LOBE_PITS
    return mat3(xyz_to_working) * value;
#else
    return value;
#endif
}

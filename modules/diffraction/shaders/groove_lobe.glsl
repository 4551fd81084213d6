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
// `peak`: of the coherent part.
float pits_density(float sum_h, float length_wavelengths, float peak) {
    float z = sum_h / lobe_gaussian.x;
    float x = 3.14159265358979 * length_wavelengths * sum_h;
    float amplitude = abs(x) < 1e-3 ? 1.0 - x * x / 6.0 : sin(x) / x;
    return peak * exp(-0.5 * z * z) + incoherent * length_wavelengths * amplitude * amplitude;
}
// Three-node Gauss-Hermite over the light's extent.
vec3 pits_factor(float sum_h, float deviation_h, float peak) {
    float step = 1.73205080756888 * deviation_h;
    vec3 factor;
    for (int o = 0; o < 3; ++o)
        factor[o] = 4.0 / 3.0 * pits_density(sum_h, pit_wavelengths[o], peak) +
                    1.0 / 3.0 * (pits_density(sum_h - step, pit_wavelengths[o], peak) +
                                 pits_density(sum_h + step, pit_wavelengths[o], peak));
    return factor;
}
vec3 groove_factor(float sum_h, float deviation_h) { return pits_factor(sum_h, deviation_h, lobe_gaussian.y); }
#else
vec3 groove_factor(float sum_h, float deviation_h) { return vec3(1.0); }
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

// Grating of a wave-optics path tracer (Steinberg, Sen & Yan 2022, Towards Practical Physical-Optics Rendering, and its
// published source): orders are found from the sines of the directions as projected into the plane across the grooves,
//   d (s_x / sqrt(s_x^2 + s_z^2) + v_x / sqrt(v_x^2 + v_z^2)) = m wavelength,
// with the efficiency of a rectangular phase grating, (sin(a / 2) sinc(m / 2))^2, a = 4 pi h / (wavelength cos theta).
// The source samples single directions; the density over them is ours: even along the grooves, or a lobe.
// peer_parameters: d in nm, h in nm, deviation of the spread (0: even), unused.
// Wavelength to colour: the fit of Wyman, Sloan & Shirley 2013, white for all wavelengths alike.
#ifndef PEER_ORDERS
#define PEER_ORDERS 5
#endif
float wyman_lobe(float x, float mean, float below, float above) {
    float t = (x - mean) / (x < mean ? below : above);
    return exp(-0.5 * t * t);
}

vec3 wavelength_colour(float x) {
    vec3 xyz = vec3(1.056 * wyman_lobe(x, 599.8, 37.9, 31.0) + 0.362 * wyman_lobe(x, 442.0, 16.0, 26.7) -
                        0.065 * wyman_lobe(x, 501.1, 20.4, 26.2),
                    0.821 * wyman_lobe(x, 568.8, 46.9, 40.5) + 0.286 * wyman_lobe(x, 530.9, 16.3, 31.1),
                    1.217 * wyman_lobe(x, 437.0, 11.8, 36.0) + 0.681 * wyman_lobe(x, 459.0, 26.0, 13.8));
    const mat3 XYZ_TO_REC709 = mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570);
    return XYZ_TO_REC709 * xyz / (106.86 * vec3(1.2048, 0.9484, 0.9087));
}

vec3 peer_reflection(vec3 s, vec3 v) {
    float path_nm = peer_parameters.x * abs(s.x * inversesqrt(s.x * s.x + s.z * s.z) +
                                            v.x * inversesqrt(v.x * v.x + v.z * v.z));
    vec3 colour = vec3(0.0);
    for (int m = 1; m <= PEER_ORDERS; m += 2) {  // a rectangular grating has no even orders
        float wavelength_nm = max(path_nm / float(m), 1.0);
        float amplitude = sin(2.0 * PI * peer_parameters.y / (wavelength_nm * v.z)) / (0.5 * PI * float(m));
        colour += amplitude * amplitude / float(m) * wavelength_colour(wavelength_nm);
    }
    float spread = 0.5;
    if (peer_parameters.z > 0.0) {
        float along = s.y * inversesqrt(s.y * s.y + s.z * s.z) + v.y * inversesqrt(v.y * v.y + v.z * v.z);
        spread = exp(-0.5 * along * along / (peer_parameters.z * peer_parameters.z)) / (2.5066283 * peer_parameters.z);
    }
    return peer_parameters.x * spread * s.z * colour;
}

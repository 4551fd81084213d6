// Compact disc after Sun, Fracchia, Drew & Calvert 2000 as extended by Egholm & Christensen 2006: mirror + diffuse +
// track * pit. With q = k1 - k2, |k| = 2 pi / wavelength:
//   track = sum_n C_n G(a q_x - 2 pi n), pit = the mean over b = 900, 1200 ... 3300 nm of sum_m C_m G(b q_y - 2 pi m).
// Here 12 wavelengths of 25 nm; phases are divided by 2 pi. C_1 = 1, C_n = C / n^2 for n > 1, and G is a normal
// distribution of peak 1.
// peer_parameters: a in nm, deviation of G, unused, C.
const vec3 BAND_COLOURS[12] = vec3[](vec3(0.0121, -0.0137, 0.1021), vec3(0.0398, -0.0500, 0.4337),
                                     vec3(-0.0041, -0.0157, 0.4208), vec3(-0.0795, 0.0821, 0.1522),
                                     vec3(-0.1595, 0.2481, 0.0121), vec3(-0.1159, 0.3641, -0.0368),
                                     vec3(0.1032, 0.3026, -0.0413), vec3(0.3831, 0.1298, -0.0270),
                                     vec3(0.4592, -0.0069, -0.0114), vec3(0.2601, -0.0270, -0.0035),
                                     vec3(0.0813, -0.0105, -0.0008), vec3(0.0202, -0.0028, -0.0002));

// One comb: only the nearest order counts, since G is narrow. `zero`: C_0.
float comb(float phase, float deviation, float zero, float high) {
    float n = abs(round(phase));
    float offset = (abs(phase) - n) / deviation;
    float weight = n == 0.0 ? zero : n == 1.0 ? 1.0 : high / (n * n);
    return weight * exp(-0.5 * offset * offset);
}

vec3 peer_reflection(vec3 s, vec3 v) {
    vec2 sum = s.xy + v.xy;
    vec3 colour = vec3(0.0);
    for (int i = 0; i < 12; ++i) {
        float wavelength_nm = 412.5 + 25.0 * float(i);
        float track = comb(peer_parameters.x * sum.x / wavelength_nm, peer_parameters.y, peer_highlight, peer_parameters.w);
        float pit = 0.0;
        for (int j = 0; j < 9; ++j)
            pit += comb((900.0 + 300.0 * float(j)) * sum.y / wavelength_nm, peer_parameters.y, 1.0, peer_parameters.w);
        colour += track * pit / 9.0 * BAND_COLOURS[i];
    }
    const float MIRROR = 0.02;  // deviation of the mirror's lobe, in direction cosines
    float mirror = exp(-0.5 * dot(sum, sum) / (MIRROR * MIRROR));
    return (colour + peer_highlight * (mirror + 0.05 * s.z)) / PI;
}

// KHR_materials_iridescence (Khronos 2022; Belcour & Barla 2017, A Practical Extension to Microfacet Theory for the
// Modeling of Varying Iridescence): a thin film over metal in place of the Fresnel term of GGX.
// peer_parameters: thickness in nm, the film's index, perceptual roughness, F0 of the metal (base colour).

// Colour of the fringes cos(2 pi path / wavelength + shift): the observer is a sum of Gaussians of frequency.
vec3 fringe_colour(float path_nm, vec3 shift) {
    float phase = 2.0e-9 * PI * path_nm;
    vec3 xyz = vec3(5.4856e-13, 4.4201e-13, 5.2481e-13) * sqrt(2.0 * PI * vec3(4.3278e9, 9.3046e9, 6.6121e9)) *
               cos(vec3(1.6810e6, 1.7953e6, 2.2084e6) * phase + shift) *
               exp(-vec3(4.3278e9, 9.3046e9, 6.6121e9) * phase * phase);
    xyz.x += 9.7470e-14 * sqrt(2.0 * PI * 4.5282e9) * cos(2.2399e6 * phase + shift.x) * exp(-4.5282e9 * phase * phase);
    const mat3 XYZ_TO_REC709 = mat3(3.2406, -0.9689, 0.0557, -1.5372, 1.8758, -0.2040, -0.4986, 0.0415, 1.0570);
    return XYZ_TO_REC709 * (xyz / 1.0685e-7);
}

vec3 schlick(vec3 f0, float cosine) { return f0 + (1.0 - f0) * pow(1.0 - cosine, 5.0); }

vec3 film_reflectance(float cosine) {
    float film = peer_parameters.y;
    float inside = sqrt(1.0 - (1.0 - cosine * cosine) / (film * film));
    float normal = (film - 1.0) / (film + 1.0);
    float outer = schlick(vec3(normal * normal), cosine).x;
    vec3 root = sqrt(vec3(peer_parameters.w));
    vec3 base_index = (1.0 + root) / (1.0 - root);
    vec3 between = (base_index - film) / (base_index + film);
    vec3 inner = schlick(between * between, inside);
    vec3 shift = PI + PI * vec3(lessThan(base_index, vec3(film)));
    vec3 both = clamp(outer * inner, 1e-5, 0.9999);
    vec3 incoherent = (1.0 - outer) * (1.0 - outer) * inner / (1.0 - both);
    vec3 sum = outer + incoherent;
    vec3 amplitude = incoherent - (1.0 - outer);
    for (int k = 1; k <= 2; ++k) {
        amplitude *= sqrt(both);
        sum += 2.0 * amplitude * fringe_colour(float(k) * 2.0 * film * peer_parameters.x * inside, float(k) * shift);
    }
    return max(sum, 0.0);
}

vec3 peer_reflection(vec3 s, vec3 v) {
    vec3 h = normalize(s + v);
    float alpha2 = pow(peer_parameters.z, 4.0);
    float peak = h.z * h.z * (alpha2 - 1.0) + 1.0;
    float smith = s.z * sqrt(v.z * v.z * (1.0 - alpha2) + alpha2) + v.z * sqrt(s.z * s.z * (1.0 - alpha2) + alpha2);
    return film_reflectance(dot(v, h)) * alpha2 / (PI * peak * peak) * 0.5 / smith * s.z;
}

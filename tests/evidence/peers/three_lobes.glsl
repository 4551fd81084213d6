// Three shifted lobes, as in shader graphs of offline renderers: a glossy lobe each for red, green and blue, whose
// normals lean across the grooves, to both sides, by an amount that grows with the channel's wavelength.
// Anisotropic GGX (Burley 2012). No paper: written from the idea.
// peer_parameters: tangent of green's lean, alpha across the grooves, alpha along them, unused.
const vec3 LEANS = vec3(610.0, 550.0, 465.0) / 550.0;

float leaning_lobe(vec3 h, float lean, vec2 alpha) {
    vec2 n = vec2(lean, 1.0) * inversesqrt(1.0 + lean * lean);
    vec3 slope = vec3((h.x * n.y - h.z * n.x) / alpha.x, h.y / alpha.y, h.x * n.x + h.z * n.y);
    float d = dot(slope, slope);
    return 1.0 / (PI * alpha.x * alpha.y * d * d);
}

vec3 peer_reflection(vec3 s, vec3 v) {
    vec3 h = normalize(s + v);
    vec3 colour;
    for (int c = 0; c < 3; ++c) {
        float lean = peer_parameters.x * LEANS[c];
        colour[c] = leaning_lobe(h, lean, peer_parameters.yz) + leaning_lobe(h, -lean, peer_parameters.yz);
    }
    return 0.5 * colour * s.z / (4.0 * max(s.z, v.z));
}

// Diffraction shader of GPU Gems (Stam 2004, chapter 8), a simplification of Stam 1999, Diffraction Shaders.
// u = d T.(s + v); each order n = 1 ... 7 adds one parabola per colour over y = 2 |u| / n - 1, and order 0 adds a
// highlight exp(-(r u / w)^2), w = n.(s + v). The unit of d puts the visible spectrum at |u| / n from 0.5 to 1.
// peer_parameters: d, r, unused, T (1: along the tracks, as the chapter says of a disc; 0: across them).
#ifndef PEER_ORDERS
#define PEER_ORDERS 7
#endif
const vec3 STAM_HIGHLIGHT = vec3(1.0, 0.7, 0.3);  // of the chapter's disc

vec3 peer_reflection(vec3 s, vec3 v) {
    vec3 h = s + v;
    float u = peer_parameters.x * mix(h.x, h.y, peer_parameters.w);
    float e = peer_parameters.y * u / h.z;
    vec3 colour = peer_highlight * exp(-e * e) * STAM_HIGHLIGHT;
    for (int n = 1; n <= PEER_ORDERS; ++n) {
        vec3 offset = 4.0 * (2.0 * abs(u) / float(n) - 1.0 - vec3(0.75, 0.5, 0.25));
        colour += max(1.0 - offset * offset, 0.0);
    }
    return colour / PI;  // a lamp of strength 1 shows a white card as 1
}

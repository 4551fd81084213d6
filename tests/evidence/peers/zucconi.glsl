// CD-ROM shader (Zucconi 2017). u = |T.s - T.v| with both directions pointing away from the surface, and T along the
// tracks; orders n = 1 ... 8 add the colour of the wavelength d u / n, and the sum is clamped to 1. The colours are six
// parabolas over (wavelength - 400 nm) / 300 nm, clamped to [0, 1]. No cosine, no efficiency.
// peer_parameters: d in nm, unused, unused, formula (1: as published; 0: repaired, u = |s + v| across the tracks).
#ifndef PEER_ORDERS
#define PEER_ORDERS 8
#endif
vec3 zucconi_bump(vec3 x, vec3 base) { return clamp(1.0 - x * x - base, 0.0, 1.0); }

vec3 zucconi_colour(float wavelength_nm) {
    vec3 x = vec3(clamp((wavelength_nm - 400.0) / 300.0, 0.0, 1.0));
    return zucconi_bump(vec3(3.54585104, 2.93225262, 2.41593945) * (x - vec3(0.69549072, 0.49228336, 0.27699880)),
                        vec3(0.02312639, 0.15225084, 0.52607955)) +
           zucconi_bump(vec3(3.90307140, 3.21182957, 3.96587128) * (x - vec3(0.11748627, 0.86755042, 0.66077860)),
                        vec3(0.84897130, 0.88445281, 0.73949448));
}

vec3 peer_reflection(vec3 s, vec3 v) {
    float path_nm = peer_parameters.x * abs(mix(s.x + v.x, s.y - v.y, peer_parameters.w));
    vec3 colour = vec3(0.0);
    if (path_nm > 0.0)
        for (int n = 1; n <= PEER_ORDERS; ++n) colour += zucconi_colour(path_nm / float(n));
    return clamp(colour, 0.0, 1.0) / PI;  // a lamp of strength 1 shows a white card as 1
}

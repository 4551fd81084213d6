// A transparent layer over the grooves: model/cover.h. The program defines COVER where there is one.
#ifdef COVER
uniform float cover_square;  // of its index of refraction

// Fraction of light that enters or leaves at this cosine in air; 0 below the horizon.
float cover_transmittance(float cosine) {
    float above = max(cosine, 0.0);
    float inside = sqrt(cover_square - 1.0 + above * above);
    float across = above + inside;
    float along = cover_square * above + inside;
    return 2.0 * above * inside * (1.0 / (across * across) + cover_square / (along * along));
}
#else
float cover_transmittance(float cosine) { return 1.0; }
#endif

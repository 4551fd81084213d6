// u = s_g + v_g over a pixel: PHYSICS (38).
struct PixelU {
    float mean;
    float square_width;  // of a box of u's variance
};

const float BOX_VARIANCE = 1.0 / 12.0;  // of a box, over its width squared

float deviation_of(PixelU u) { return sqrt(BOX_VARIANCE * u.square_width); }

// The tangent frame of a pixel and the view in it, where something needs it.
#if defined(PIXEL_SHADED) || defined(HAS_DIRECT)

in vec3 world_grating;

struct GrooveView {
    mat3 axes;        // columns g, h, n in the world
    vec3 direction;   // toward the eye, in (g, h, n)
    float footprint;  // half the extent of the pixel in v_g
};

// The grating vector of the vertices, interpolated, made orthonormal to the normal again. Where the vertices' cancel, as
// at a disc's hub, any will do.
mat3 groove_axes() {
    vec3 n = normalize(world_normal);
    vec3 g = world_grating - n * dot(n, world_grating);
    if (dot(g, g) < 1e-12) g = cross(n, abs(n.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0));
    g = normalize(g);
    return mat3(g, cross(n, g), n);
}

// Takes differences between pixels: call it where all pixels pass.
GrooveView groove_view() {
    mat3 axes = groove_axes();
    vec3 direction = normalize(eye.xyz - world_position) * axes;
    return GrooveView(axes, direction, 0.5 * fwidth(direction.x));
}

#endif

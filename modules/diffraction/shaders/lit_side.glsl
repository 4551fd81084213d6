// A sheet that transmits shows the light behind it: it is shaded as the other side of its surface, seen by the view that is
// mirrored in the surface (PHYSICS (44)). The program defines TRANSMISSION.
#ifdef TRANSMISSION
const float LIT_SIDE = -1.0;
#else
const float LIT_SIDE = 1.0;
#endif

// The frame (g, h, n) of the lit side.
mat3 lit_axes(vec3 g, vec3 h, vec3 n) { return mat3(g, LIT_SIDE * h, LIT_SIDE * n); }

// The view, toward the eye in the world, in the lit side's frame.
vec3 lit_view_direction(vec3 to_eye, mat3 axes) {
    vec3 direction = to_eye * axes;
    return vec3(direction.xy, LIT_SIDE * direction.z);
}

// The picture's pixels, the grid's cells (glare.h), and the light that the sheet diffracts.

layout(binding = 0) uniform sampler2D scene_linear;
uniform vec2 tan_half_fov;
uniform ivec2 cells;
uniform float cell;
uniform float threshold;

// As in bloom_grid.glsl.
vec3 usable(vec3 colour) {
    bvec3 is_finite = lessThan(floatBitsToUint(colour) & 0x7fffffffu, uvec3(0x7f800000u));
    return clamp(mix(vec3(0.0), colour, is_finite), -65504.0, 65504.0);
}

vec3 bright(vec3 colour) {
    float brightest = max(colour.r, max(colour.g, colour.b));
    return brightest > threshold ? (1.0 - threshold / brightest) * colour : vec3(0.0);
}

// The point of the plane at distance 1 that a pixel's centre shows.
vec2 tangents(ivec2 pixel) {
    return tan_half_fov * (2.0 * (vec2(pixel) + 0.5) / vec2(textureSize(scene_linear, 0)) - 1.0);
}

// The cells' coordinates of the direction through a point of that plane; centres of cells are at integers.
vec2 position_in_cells(vec2 at) {
    return at * inversesqrt(1.0 + dot(at, at)) / cell + 0.5 * vec2(cells - 1);
}

// The uniform quadratic B-spline of both distances. It makes light equally wide wherever the light lies between cells,
// so that streaks are even; linear interpolation would show the cells.
float spline(vec2 distances) {
    vec2 d = abs(distances);
    vec2 tail = max(1.5 - d, vec2(0.0));
    vec2 weight = mix(0.5 * tail * tail, 0.75 - d * d, lessThan(d, vec2(0.5)));
    return weight.x * weight.y;
}

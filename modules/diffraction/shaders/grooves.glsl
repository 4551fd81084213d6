// The grooves at a pixel: the lit side, the cover over them, the tangent frame, the view in it, and what the pixel covers
// (PHYSICS §11). Vertex stages define VERTEX_STAGE and use only what precedes world_grating.

// The stage that shades the analytic lights: points and spots at the pixels; under SEPARATE_LIGHTS the probe's key lights
// and directional lights at the pixels or, under LIGHTS_AT_VERTICES, at the vertices.
#if defined(PUNCTUAL_LIGHTS) || (defined(SEPARATE_LIGHTS) && !defined(LIGHTS_AT_VERTICES))
#define LIGHTS_AT_PIXELS
#endif
// Lights of the scene, which are points or small discs.
#if (defined(SEPARATE_LIGHTS) && defined(DIRECTIONAL_LIGHTS)) || defined(PUNCTUAL_LIGHTS)
#define SMALL_LIGHTS
#endif
// A light that the vertices shade, with its shadow at the pixels.
#if defined(LIGHTS_AT_VERTICES) && defined(DIRECTIONAL_LIGHTS) && defined(SHADOWS)
#define SHADOWED_AT_PIXELS
#endif
// The vertices shade these lights and the pixels the rest. Where vertices shade everything, the sum is one output.
#if defined(LIGHTS_AT_VERTICES) && !defined(VERTEX_SHADED)
#define LIGHTS_FROM_VERTICES
#endif
// The layers of an arc table's products that reach the pixels. OpenGL guarantees 60 components between the stages: all four
// fit if the mesh passes nothing else, and three if it does not pass colours beside lights from the vertices.
#ifndef SHOWN_LAYERS
#if defined(LIGHTS_FROM_VERTICES) && defined(HAS_COLOURS) && (defined(HAS_UV) || defined(HAS_UV1))
#define SHOWN_LAYERS min(LAYERS, 2)
#elif !defined(TURNS) && (defined(HAS_UV) || defined(HAS_UV1) || defined(HAS_COLOURS) || defined(NORMAL_MAP) || \
                          defined(LIGHTS_FROM_VERTICES))
#define SHOWN_LAYERS min(LAYERS, 3)
#else
#define SHOWN_LAYERS LAYERS
#endif
#endif

// A sheet that transmits shows the light behind it: it is shaded as the other side of its surface, seen by the view that is
// mirrored in the surface (PHYSICS (12.3)). The program defines TRANSMISSION.
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

// A transparent layer over the grooves: model/grating.h. The program defines COVER where there is one.
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

// u = s_g + v_g over a pixel: PHYSICS (11.1).
struct PixelU {
    float mean;
    float square_width;  // of a box of u's variance
};

const float BOX_VARIANCE = 1.0 / 12.0;  // of a box, over its width squared

float deviation_of(PixelU u) { return sqrt(BOX_VARIANCE * u.square_width); }

#ifndef VERTEX_STAGE
in vec3 world_grating;

#ifdef GROOVE_MAP
// The pixel before the map's rotation, and differences to the pixels beside and below.
struct MeshView {
    mat3 axes;
    vec3 direction;
    mat2x3 h_change;
    vec2 v_h_change;
    vec2 map_uv;
    mat2 map_uv_change;
};
#endif

struct GrooveView {
    mat3 axes;       // columns g, h, n in the world, of the lit side
    vec3 direction;  // toward the eye, in (g, h, n)
    float pitch;     // over the material's; 0: no grating here
    // Differences of g and v_g to the pixels beside and below, before a map's rotation.
    mat2x3 g_change;
    vec2 v_g_change;
#ifdef LATTICE
    mat2x3 h_change;
    vec2 v_h_change;
#endif
#ifdef GROOVE_MAP
    MeshView mesh;
    vec2 turn;       // cosine and sine of the map's mean rotation
    float fade;      // mean cosine of the grooves' angles to it
    vec2 spread;     // factors of u_h^2 and u_g^2 in the variance of u
    float coverage;  // fraction of the area that has a grating
#endif
};

// `s`: toward the light, in the world.
#ifdef GROOVE_MAP
// s + v along g and h of the mesh, and its differences to the pixels beside and below.
struct MeshU {
    vec2 u;
    mat2 change;
};

vec2 mesh_sum(MeshView mesh, vec3 s) { return vec2(dot(s, mesh.axes[0]), dot(s, mesh.axes[1])) + mesh.direction.xy; }

// From the mesh's g and h to those of the pixel's grooves.
vec2 turned(GrooveView view, vec2 along) {
    return vec2(dot(view.turn, along), view.turn.x * along.y - view.turn.y * along.x);
}

// A direction in the world, in (g, h, n).
vec3 to_tangent(GrooveView view, vec3 s) {
    vec3 in_mesh = s * view.mesh.axes;
    return vec3(turned(view, in_mesh.xy), in_mesh.z);
}

PixelU turned_pixel_u(GrooveView view, MeshU mesh) {
    vec2 u = turned(view, mesh.u);
    // The mesh's own change, as the map may be discontinuous: its moments tell how it varies.
    vec2 across = view.turn * mesh.change;
    float spread_square = dot(view.spread, vec2(u.y * u.y, u.x * u.x));
    return PixelU(view.fade * u.x, dot(across, across) + spread_square / BOX_VARIANCE);
}

PixelU pixel_u(GrooveView view, vec3 s) {
    vec2 change_g = s * view.g_change + view.v_g_change;
    vec2 change_h = s * view.mesh.h_change + view.mesh.v_h_change;
    return turned_pixel_u(view, MeshU(mesh_sum(view.mesh, s), transpose(mat2(change_g, change_h))));
}

// For any `s` that varies from pixel to pixel. Uses derivatives: call it in uniform control flow.
MeshU mesh_u_of(GrooveView view, vec3 s) {
    vec2 u = mesh_sum(view.mesh, s);
    return MeshU(u, mat2(dFdx(u), dFdy(u)));
}
#else
vec3 to_tangent(GrooveView view, vec3 s) { return s * view.axes; }

PixelU pixel_u(GrooveView view, vec3 s) {
    vec2 change = s * view.g_change + view.v_g_change;
    return PixelU(dot(s, view.axes[0]) + view.direction.x, dot(change, change));
}

// The same for any `s` that varies from pixel to pixel. Uses derivatives: call it in uniform control flow.
PixelU pixel_u_of(GrooveView view, vec3 s) {
    float u = dot(s, view.axes[0]) + view.direction.x;
    vec2 change = vec2(dFdx(u), dFdy(u));
    return PixelU(u, dot(change, change));
}
#endif

// The interpolated grating vector, made orthonormal to the normal; shorter where the vertices' vectors cancel, as at a
// disc's hub.
mat3 groove_axes() {
    vec3 n = LIT_SIDE * normalize(world_normal);
    vec3 g = world_grating - n * dot(n, world_grating);
    g *= inversesqrt(max(dot(g, g), 1e-12));
    return mat3(g, cross(n, g), n);
}

#ifdef GROOVE_MAP
// Means over the grooves: runtime/groove_map.h.
TEXTURE_UNIT(13) uniform sampler2D groove_map;
#ifdef GL_ES
uniform sampler2D groove_map_rest;  // what halves round off: ES filters no 16 bits
#endif
uniform vec4 groove_uv_linear;
uniform vec2 groove_uv_offset;
uniform float groove_pitch;  // the smallest, over the material's
#ifdef GROOVE_SPARKLE
uniform float facet_texels;  // mean area of a facet
#endif
in float groove_hand;

vec4 mean_moments(vec2 uv) {
#ifdef GL_ES
    return texture(groove_map, uv) + texture(groove_map_rest, uv);
#else
    return texture(groove_map, uv);
#endif
}

vec4 mean_moments(vec2 uv, mat2 width) {
#ifdef GL_ES
    return textureGrad(groove_map, uv, width[0], width[1]) + textureGrad(groove_map_rest, uv, width[0], width[1]);
#else
    return textureGrad(groove_map, uv, width[0], width[1]);
#endif
}

// Relative error of the moments' rounding: a value this little below 1 counts as 1.
const float MOMENT_ROUNDING = 1e-4;

// The cosine and the sine, which is not negative, of half the angle of a vector.
vec2 half_angle(vec2 whole) {
    float longer = sqrt(0.5 + 0.5 * abs(whole.x));
    float shorter = 0.5 * whole.y / longer;
    return whole.x > 0.0 ? vec2(shorter < 0.0 ? -longer : longer, abs(shorter)) : vec2(shorter, longer);
}

// The grooves that the moments describe.
GrooveView grooves_of(MeshView mesh, mat2x3 g_change, vec2 v_g_change, vec4 moments) {
    float coverage = 1.0;
    float inverse_variance = max(moments.w / max(moments.z * moments.z, 1e-12) - 1.0 - MOMENT_ROUNDING, 0.0);
#ifdef GROOVE_GAPS
    coverage = moments.w;
    inverse_variance = 0.0;
#endif
    vec2 mean = 2.0 * moments.xy - 1.0;
    float order = max(length(mean), 1e-6);
    vec2 turn = mean / order;
    float fade = min(order * (1.0 + MOMENT_ROUNDING) / max(coverage, 1e-6), 1.0);
#ifdef GROOVES_EVEN
    turn = half_angle(turn);
    fade = sqrt(sqrt(fade));
#endif
    turn.y *= groove_hand;
    float square = fade * fade;
    float lost = 1.0 - square;
    vec2 spread = vec2(0.5 - 0.5 * square * square, 0.5 * lost * lost + square * inverse_variance);
    vec3 g = mesh.axes[0];
    vec3 h = mesh.axes[1];
    vec3 v = mesh.direction;
    mat3 turned = mat3(turn.x * g + turn.y * h, turn.x * h - turn.y * g, mesh.axes[2]);
    vec3 direction = vec3(dot(turn, v.xy), turn.x * v.y - turn.y * v.x, v.z);
    float pitch = moments.z > 0.0 ? groove_pitch * coverage / moments.z : 0.0;
    return GrooveView(turned, direction, pitch, g_change, v_g_change, mesh, turn, fade, spread, coverage);
}

#include GROOVE_SPARKLE
#ifndef GROOVE_SPARKLE
// A pixel whose grooves vary is divided into parts, since two distinct directions in it are no normal distribution;
// into fewer parts where they vary little, as with a texture that rotates the grooves steadily.
const float VARYING = 1e-3;
const float VARYING_MUCH = 1e-2;

int groove_parts(GrooveView view) {
    float variation = view.spread.x + view.spread.y;
#ifdef FINE_GROOVE_PARTS
    vec2 size = vec2(textureSize(groove_map, 0));
    float texels = abs(determinant(view.mesh.map_uv_change)) * size.x * size.y;
    return variation > VARYING ? int(clamp(2.0 * texels, 8.0, 64.0)) : 1;  // two for each texel
#else
    return variation > VARYING_MUCH ? 16 : variation > VARYING ? 4 : 1;
#endif
}

// The moments of one of `parts` of the pixel. At level 0 its point moves to the centre of a texel, as grooves interpolated
// between two texels would be those of neither.
#ifdef FINE_GROOVE_PARTS
// At a point of a golden-ratio lattice.
vec4 part_moments(MeshView mesh, int parts, int part) {
    mat2 change = mesh.map_uv_change;
    vec2 at = vec2((float(part) + 0.5) / float(parts), fract(0.61803399 * float(part))) - 0.5;
    vec2 texels = vec2(textureSize(groove_map, 0));
    vec2 steps = max(abs(change[0]), abs(change[1])) * texels;
    float level = max(log2(max(steps.x, steps.y) / 16.0), 0.0);
    vec2 uv = mesh.map_uv + change * at;
    if (level == 0.0) uv = (floor(uv * texels) + 0.5) / texels;
    return textureLod(groove_map, uv, level);
}
#else
// Asks for half the part's width: a trilinear look-up averages over about twice the width that it is asked for.
vec4 part_moments(MeshView mesh, int parts, int part) {
    int bits = parts == 4 ? 1 : 2;  // of the part's column and of its row
    float side = parts == 4 ? 0.5 : 0.25;
    vec2 at = (vec2(part & ((1 << bits) - 1), part >> bits) + 0.5) * side - 0.5;
    vec2 uv = mesh.map_uv + mesh.map_uv_change * at;
    mat2 width = mesh.map_uv_change * (0.5 * side);
    vec2 texels = vec2(textureSize(groove_map, 0));
    vec2 squares = vec2(dot(width[0] * texels, width[0] * texels), dot(width[1] * texels, width[1] * texels));
    if (max(squares.x, squares.y) <= 1.0) uv = (floor(uv * texels) + 0.5) / texels;
    return mean_moments(uv, width);
}
#endif

// One of `parts`; `view`: the whole pixel.
GrooveView groove_part(GrooveView view, int parts, int part) {
    if (parts == 1) return view;
    return grooves_of(view.mesh, view.g_change, view.v_g_change, part_moments(view.mesh, parts, part));
}
#endif
#endif

// Uses derivatives: call it in uniform control flow.
GrooveView groove_view() {
    mat3 axes = groove_axes();
    vec3 direction = lit_view_direction(normalize(eye.xyz - world_position), axes);
    mat2x3 g_change = mat2x3(dFdx(axes[0]), dFdy(axes[0]));
    vec2 v_g_change = vec2(dFdx(direction.x), dFdy(direction.x));
#ifdef GROOVE_MAP
    vec2 uv = groove_uv_linear.xy * GROOVE_MAP.x + groove_uv_linear.zw * GROOVE_MAP.y + groove_uv_offset;
    MeshView mesh = MeshView(axes, direction, mat2x3(dFdx(axes[1]), dFdy(axes[1])),
                             vec2(dFdx(direction.y), dFdy(direction.y)), uv, mat2(dFdx(uv), dFdy(uv)));
#ifdef GROOVE_SPARKLE
    vec4 moments = find_sparkle(mesh);
#else
    vec4 moments = mean_moments(uv);
#endif
    return grooves_of(mesh, g_change, v_g_change, moments);
#elif defined(LATTICE)
    return GrooveView(axes, direction, 1.0, g_change, v_g_change, mat2x3(dFdx(axes[1]), dFdy(axes[1])),
                      vec2(dFdx(direction.y), dFdy(direction.y)));
#else
    return GrooveView(axes, direction, 1.0, g_change, v_g_change);
#endif
}
#endif

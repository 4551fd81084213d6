// The tangent frame of a pixel and the view in it.
#include "modules/diffraction/shaders/has_direct.glsl"
#if !defined(VERTEX_SHADED) || defined(LIGHTS_AT_PIXELS)

in vec3 world_grating;

#ifdef GROOVE_MAP
layout(binding = 13) uniform sampler2D groove_map;  // r: rotation / pi; g: half the pitch over the material's
uniform vec4 groove_uv_linear;
uniform vec2 groove_uv_offset;
in float groove_hand;
#endif

struct GrooveView {
    mat3 axes;        // columns g, h, n in the world
    vec3 direction;   // toward the eye, in (g, h, n)
    float footprint;  // half the extent of the pixel in v_g
    float pitch;      // over the material's; 0: no grating here
};

// The interpolated grating vector, made orthonormal to the normal; shorter where the vertices' vectors cancel, as at a
// disc's hub.
mat3 groove_axes() {
    vec3 n = normalize(world_normal);
    vec3 g = world_grating - n * dot(n, world_grating);
    g *= inversesqrt(max(dot(g, g), 1e-12));
    return mat3(g, cross(n, g), n);
}

// Uses derivatives: call it in uniform control flow.
GrooveView groove_view() {
    mat3 axes = groove_axes();
    vec3 direction = normalize(eye.xyz - world_position) * axes;
#ifdef GROOVE_MAP
    vec2 map_uv = groove_uv_linear.xy * GROOVE_MAP.x + groove_uv_linear.zw * GROOVE_MAP.y + groove_uv_offset;
    vec2 texel = texture(groove_map, map_uv).rg;
    float angle = 3.14159265358979 * texel.r;
    vec2 turn = vec2(cos(angle), groove_hand * sin(angle));
    // Derivatives of the view before the map's rotation, which may be discontinuous.
    float extent = abs(dot(turn, dFdx(direction.xy))) + abs(dot(turn, dFdy(direction.xy)));
    mat2 turned = mat2(turn.x, turn.y, -turn.y, turn.x);
    axes = mat3(mat2x3(axes[0], axes[1]) * turned[0], mat2x3(axes[0], axes[1]) * turned[1], axes[2]);
    direction.xy = direction.xy * turned;
    return GrooveView(axes, direction, 0.5 * extent, 2.0 * texel.g);
#else
    return GrooveView(axes, direction, 0.5 * fwidth(direction.x), 1.0);
#endif
}

#endif

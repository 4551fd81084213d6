// The shadow map's light is a disc: engine/render/soft_shadow.h.
TEXTURE_UNIT(2) uniform sampler2D shadow_map;

const int SHADOW_TAPS = 16;
const float WIDEST_PENUMBRA = 24.0;  // texels

// Points of a disc at equal areas: Vogel's spiral. `turn` is turned by the golden angle for the next one.
vec2 next_of_disc(int i, inout vec2 turn) {
    turn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688) * turn;
    return sqrt((float(i) + 0.5) / float(SHADOW_TAPS)) * turn;
}

// Change of the map's depth along its axes on a surface of normal n, as seen by the light.
vec2 depth_slope(vec3 n) {
    mat3 axes = transpose(mat3(world_to_shadow));
    vec3 across = n * axes;
    float stretch = dot(axes[2], axes[2]) / dot(axes[0], axes[0]);
    return clamp(across.xy / min(across.z, -1e-6) * -stretch, vec2(-8.0), vec2(8.0));
}

// Filtered as four texels, of which each is compared by itself.
float lit_fraction(vec2 uv, float depth) {
    vec4 lit = step(vec4(depth), textureGather(shadow_map, uv));
    vec2 part = fract(uv / shadow.y - 0.5);
    return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}

// Fraction of the disc that a point sees. `at`: in the map; n: toward the light.
float disc_visibility(vec3 at, vec3 n) {
    vec2 slope = depth_slope(n);
    float reach = clamp(shadow.w * at.z, shadow.y, WIDEST_PENUMBRA * shadow.y);
    vec2 turn = vec2(1.0, 0.0);
    float blockers = 0.0;
    float depths = 0.0;
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        vec2 away = reach * next_of_disc(i, turn);
        vec4 seen = textureGather(shadow_map, at.xy + away);
        vec4 blocks = 1.0 - step(vec4(at.z + dot(slope, away)), seen);
        blockers += dot(blocks, vec4(1.0));
        depths += dot(blocks, seen);
    }
    if (blockers == 0.0) return 1.0;
    if (blockers == 4.0 * float(SHADOW_TAPS)) return 0.0;
    float radius = clamp(shadow.w * (at.z - depths / blockers), shadow.y, reach);
    float lit = 0.0;
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        vec2 away = radius * next_of_disc(i, turn);
        lit += lit_fraction(at.xy + away, at.z + dot(slope, away));
    }
    return lit / float(SHADOW_TAPS);
}

// The surface at a pixel: what the vertices pass, its maps, and the visibility of light. The program's defines name
// maps by the texture coordinates they use, uv or uv1 (engine/render/surface_programs.h).
#include "engine/render/shaders/scene_blocks.h"

const float PI = 3.14159265358979;

in vec3 world_position;
in vec3 world_normal;
#ifdef NORMAL_MAP
in vec4 world_tangent;
#endif
#ifdef HAS_UV
in vec2 uv;
#endif
#ifdef HAS_UV1
in vec2 uv1;
#endif
#ifdef HAS_COLOURS
in vec4 colour;
#endif

#ifdef TEXTURE_TRANSFORM
vec2 map_coordinates(int map, vec2 coordinates) {
    return uv_linear[map].xy * coordinates.x + uv_linear[map].zw * coordinates.y + uv_offset[map].xy;
}
#else
vec2 map_coordinates(int map, vec2 coordinates) { return coordinates; }
#endif

#ifdef BASE_COLOUR_MAP
TEXTURE_UNIT(3) uniform sampler2D base_colour_map;
#endif
// Working space; a: alpha.
vec4 surface_colour() {
    vec4 product = base_colour;
#ifdef BASE_COLOUR_MAP
    product *= texture(base_colour_map, map_coordinates(0, BASE_COLOUR_MAP));
#endif
#ifdef HAS_COLOURS
    product *= colour;
#endif
#if defined(BASE_COLOUR_MAP) || defined(HAS_COLOURS)
    product.rgb = mat3(rec709_to_working) * product.rgb;
#endif
    return product;
}

#ifdef METALLIC_ROUGHNESS_MAP
TEXTURE_UNIT(4) uniform sampler2D metallic_roughness_map;
vec2 surface_metallic_roughness() {
    return metallic_roughness.xy * texture(metallic_roughness_map, map_coordinates(1, METALLIC_ROUGHNESS_MAP)).bg;
}
#else
vec2 surface_metallic_roughness() { return metallic_roughness.xy; }
#endif

#ifdef NORMAL_MAP
TEXTURE_UNIT(5) uniform sampler2D normal_map;  // TexelMeaning::Normal in engine/render/surface_textures.h
vec4 normal_texel() { return texture(normal_map, map_coordinates(2, NORMAL_MAP)); }
#endif
// World space, unit, on the side that is seen.
vec3 surface_normal() {
    vec3 n = normalize(world_normal);
#ifdef NORMAL_MAP
    vec3 t = normalize(world_tangent.xyz);
    vec3 b = cross(n, t) * world_tangent.w;
    vec3 bent = normal_texel().xyz * 2.0 - 1.0;
    bent.xy *= map_strength.x;
    n = normalize(t * bent.x + b * bent.y + n * bent.z);
#endif
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) n = -n;
#endif
    return n;
}

#ifdef OCCLUSION_MAP
TEXTURE_UNIT(6) uniform sampler2D occlusion_map;
float surface_occlusion() {
    return 1.0 + map_strength.y * (texture(occlusion_map, map_coordinates(3, OCCLUSION_MAP)).r - 1.0);
}
#else
float surface_occlusion() { return 1.0; }
#endif

#ifdef EMISSIVE_MAP
TEXTURE_UNIT(7) uniform sampler2D emissive_map;
vec3 surface_emission() {
    return mat3(rec709_to_working) * (emissive.rgb * texture(emissive_map, map_coordinates(4, EMISSIVE_MAP)).rgb);
}
#else
vec3 surface_emission() { return emissive.rgb; }
#endif

// Perceptual roughness of a lobe that is widened by the variation of the normals within the pixel: the variances of
// their slopes are added to GGX's alpha^2 [Tokuyoshi & Kaplanyan 2019], both the variance within the map's texels and
// that over a box as wide as the pixel. Without a normal map, the roughness alone. Uses derivatives: call it in uniform
// control flow.
float seen_roughness(float roughness, vec3 n) {
#ifdef NORMAL_MAP
    float deviation = 2.0 * map_strength.x * normal_texel().a;
    vec3 right = dFdx(n);
    vec3 up = dFdy(n);
    float variance = min((dot(right, right) + dot(up, up)) / 12.0, 0.18) + deviation * deviation;
    float square = roughness * roughness;
    return sqrt(sqrt(min(square * square + variance, 1.0)));
#else
    return roughness;
#endif
}

// Toward the eye, unit.
vec3 to_eye() { return normalize(eye.xyz - world_position); }

// The normal, bent to n.v = 0 where it faces away from the view: at an outline, a pixel's centre may lie outside its
// triangle.
vec3 seen_normal(vec3 n, vec3 v) { return n - min(dot(n, v), 0.0) * v; }

// Fresnel reflectance [Schlick 1994].
vec3 schlick_reflectance(vec3 f0, float cosine) {
    float rise = 1.0 - cosine;
    float rise2 = rise * rise;
    float rise5 = rise2 * rise2 * rise;
    return f0 * (1.0 - rise5) + rise5;
}

// Visibility from the depth of the picture: engine/render/effects.h. Call read_screen_visibility() first.
#ifdef AMBIENT_OCCLUSION
TEXTURE_UNIT(16) uniform sampler2D visibility_map;

vec2 screen_visibility;  // of ambient light, of the light that casts shadows

// Interpolates the four nearest texels of the smaller picture, with larger weights for those at the pixel's depth.
void read_screen_visibility() {
    vec2 at = gl_FragCoord.xy * dome.zw * vec2(textureSize(visibility_map, 0)) - 0.5;
    ivec2 last = textureSize(visibility_map, 0) - 1;
    ivec2 corner = ivec2(floor(at));
    vec2 part = at - vec2(corner);
    vec2 sum = vec2(0.0);
    float weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 step = ivec2(i & 1, i >> 1);
        vec3 texel = texelFetch(visibility_map, clamp(corner + step, ivec2(0), last), 0).xyz;
        vec2 near = mix(1.0 - part, part, vec2(step));
        float weight = (near.x * near.y + 1e-3) / (1e-3 + abs(texel.z * gl_FragCoord.w - 1.0));
        sum += weight * texel.xy;
        weights += weight;
    }
    screen_visibility = sum / weights;
}
#else
const vec2 screen_visibility = vec2(1.0);
void read_screen_visibility() {}
#endif
float ambient_visibility() { return screen_visibility.x; }

// Points of a disc at equal areas: Vogel's spiral. `turn` is rotated by the golden angle for the next one.
vec2 next_of_disc(int i, int points, inout vec2 turn) {
    turn = mat2(-0.7373688, 0.6754903, -0.6754903, -0.7373688) * turn;
    return sqrt((float(i) + 0.5) / float(points)) * turn;
}

// The first directional light's shadow map.
#ifdef SHADOWS
#ifdef SOFT_SHADOWS
TEXTURE_UNIT(2) uniform sampler2D shadow_map;
#else
TEXTURE_UNIT(2) uniform sampler2DShadow shadow_map;
#endif

// Four filtered comparisons half a texel apart reach 1.5 texels along each axis. Within that reach, a plane lies at
// most 1.5 sqrt(2) texels * tan(angle to the light) nearer to the light than at the point; a point lifted by as many
// texels times the sine stays above it.
const float SHADOW_LIFT = 2.2;

// A surface's point in the map. n: the surface's normal on the light's side; l: toward the light.
vec3 shadow_coordinates(vec3 position, vec3 n, vec3 l) {
    vec3 lifted = position + n * (SHADOW_LIFT * shadow.x * length(cross(n, l)));
    vec3 at = (world_to_shadow * vec4(lifted, 1.0)).xyz * 0.5 + 0.5;
    at.z = min(at.z, 1.0);  // behind everything that casts a shadow
    return at;
}

#ifdef SOFT_SHADOWS
// The light is a disc: percentage-closer soft shadows, engine/render/scene_lights.h.
const int SHADOW_TAPS = 16;
const float NARROWEST_PENUMBRA = 1.5;  // texels
const float WIDEST_PENUMBRA = 24.0;

// Change of the map's depth along its axes on a surface of normal n, as seen by the light.
vec2 depth_slope(vec3 n) {
    mat3 axes = transpose(mat3(world_to_shadow));
    vec3 across = n * axes;
    float stretch = dot(axes[2], axes[2]) / dot(axes[0], axes[0]);
    return clamp(across.xy / min(across.z, -1e-6) * -stretch, vec2(-8.0), vec2(8.0));
}

// Bilinear filter of four texels' comparisons.
float shadow_tap(vec3 at) {
    vec4 lit = step(vec4(at.z), textureGather(shadow_map, at.xy));
    vec2 part = fract(at.xy / shadow.y - 0.5);
    return mix(mix(lit.w, lit.z, part.x), mix(lit.x, lit.y, part.x), part.y);
}

// Fraction of the disc that is visible from a point of the map. n: the surface's normal on the light's side.
float lit_fraction(vec3 at, vec3 n) {
    vec2 slope = depth_slope(n);
    float reach = clamp(shadow.w * at.z, NARROWEST_PENUMBRA * shadow.y, WIDEST_PENUMBRA * shadow.y);
    vec2 turn = vec2(1.0, 0.0);
    float blockers = 0.0;
    float depths = 0.0;
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        vec2 away = reach * next_of_disc(i, SHADOW_TAPS, turn);
        vec4 seen = textureGather(shadow_map, at.xy + away);
        vec4 blocks = 1.0 - step(vec4(at.z + dot(slope, away)), seen);
        blockers += dot(blocks, vec4(1.0));
        depths += dot(blocks, seen);
    }
    if (blockers == 0.0) return 1.0;
    if (blockers == 4.0 * float(SHADOW_TAPS)) return 0.0;
    float radius = clamp(shadow.w * (at.z - depths / blockers), NARROWEST_PENUMBRA * shadow.y, reach);
    float lit = 0.0;
    for (int i = 0; i < SHADOW_TAPS; ++i) {
        vec2 away = radius * next_of_disc(i, SHADOW_TAPS, turn);
        lit += shadow_tap(vec3(at.xy + away, at.z + dot(slope, away)));
    }
    // Few blockers fade in, as some pixels' taps miss a thin object.
    return mix(1.0, lit / float(SHADOW_TAPS), min(0.125 * blockers, 1.0));
}
#else
float shadow_tap(vec3 at) { return texture(shadow_map, at); }

float lit_fraction(vec3 at, vec3 n) {
    vec2 half_texel = vec2(0.5, -0.5) * shadow.y;
    return 0.25 * (shadow_tap(vec3(at.xy + half_texel.xx, at.z)) + shadow_tap(vec3(at.xy + half_texel.xy, at.z)) +
                   shadow_tap(vec3(at.xy + half_texel.yx, at.z)) + shadow_tap(vec3(at.xy + half_texel.yy, at.z)));
}
#endif

// Fraction of the first directional light that reaches the pixel.
float shadow_visibility(vec3 l) {
    vec3 n = normalize(world_normal);
    if (dot(n, l) < 0.0) n = -n;
    return screen_visibility.y * lit_fraction(shadow_coordinates(world_position, n, l), n);
}
#endif

// What a reflected ray meets nearby: engine/render/local_reflection.h.
#include "engine/render/shaders/reflection_block.h"
TEXTURE_UNIT(17) uniform sampler2D plane_map;

// The plane's visibility of ambient light where the picture shows that point; 1 where something hides it.
float ambient_visibility_at(vec3 position) {
#ifdef AMBIENT_OCCLUSION
    vec4 clip = view_projection * vec4(position, 1.0);
    vec2 uv = 0.5 + 0.5 * clip.xy / clip.w;
    if (clip.w <= 0.0 || any(greaterThan(abs(uv - 0.5), vec2(0.5)))) return 1.0;
    vec3 texel = textureLod(visibility_map, uv, 0.0).xyz;
    return mix(1.0, texel.x, max(1.0 - abs(texel.z / clip.w - 1.0) * 30.0, 0.0));
#else
    return 1.0;
#endif
}

// Not textureSize(plane_map, level), which llvmpipe takes from one pixel's level for its neighbours.
ivec2 plane_map_size(int level) { return max(textureSize(plane_map, 0) >> level, ivec2(1)); }

// The map repeats.
vec3 plane_texel(ivec2 texel, int level) {
    ivec2 size = plane_map_size(level);
    return texelFetch(plane_map, (texel % size + size) % size, level).rgb;
}

// Filtered here: where neighbours meet no plane, an anisotropic filter has no gradients, and llvmpipe's then never ends.
vec3 plane_albedo(vec2 at, float footprint) {
    if (plane_size.w == 0.0) return plane_colour.rgb;
    vec2 uv = plane_uv_linear.xy * at.x + plane_uv_linear.zw * at.y + plane_uv_offset.xy;
    vec2 texels = vec2(textureSize(plane_map, 0)) * (abs(plane_uv_linear.xy) + abs(plane_uv_linear.zw));
    float width = footprint * max(texels.x, texels.y);
    int level = clamp(int(log2(max(width, 1.0)) + 0.5), 0, textureQueryLevels(plane_map) - 1);
    vec2 position = uv * vec2(plane_map_size(level)) - 0.5;
    ivec2 corner = ivec2(floor(position));
    vec2 part = position - vec2(corner);
    vec3 texel = mix(mix(plane_texel(corner, level), plane_texel(corner + ivec2(1, 0), level), part.x),
                     mix(plane_texel(corner + ivec2(0, 1), level), plane_texel(corner + ivec2(1, 1), level), part.x),
                     part.y);
    return mat3(rec709_to_working) * (plane_colour.rgb * texel);
}

// What the plane's own lobe reflects of the environment toward the mirror.
vec3 plane_gloss(vec3 direction, float visibility) {
    float roughness = plane_normal.w;
    vec2 split = textureLod(brdf_table, vec2(-dot(direction, plane_normal.xyz), roughness), 0.0).rg;
    vec3 seen = lobe_direction(plane_normal.xyz, -direction, roughness);
    vec3 light = textureLod(environment_map, seen, environment_level(roughness)).rgb * environment.y;
    return light * ((0.04 * split.x + split.y) * visibility);
}

// The light from a direction: that of the plane, if the ray meets it, in place of the environment's. A rough surface
// sees a blurred edge and map.
vec3 with_local_reflection(vec3 environment_radiance, vec3 direction, float roughness) {
    vec3 from = (world_to_plane * vec4(world_position, 1.0)).xyz;
    vec3 along = mat3(world_to_plane) * direction;
    if (along.y >= 0.0 || from.y <= 0.0) return environment_radiance;
    float distance = from.y / -along.y;
    vec2 at = from.xz + distance * along.xz;
    // Of a GGX lobe, half of whose light is within an angle of about its roughness squared; and of the pixel.
    float footprint = 2.0 * roughness * roughness * distance + plane_size.z * (distance + 1.0 / gl_FragCoord.w);
    vec2 inside = clamp((plane_size.xy - abs(at)) / footprint + 0.5, 0.0, 1.0);
    float coverage = inside.x * inside.y;
    if (coverage <= 0.0) return environment_radiance;
    vec3 met = world_position + distance * direction;
    float visibility = ambient_visibility_at(met);
    vec3 light = visibility * plane_ambient.rgb;
#ifdef SHADOWS
    light += shadow_tap(shadow_coordinates(met, plane_normal.xyz, lights[0].position.xyz)) * plane_lamp.rgb;
#endif
    return mix(environment_radiance, plane_albedo(at, footprint) * light + plane_gloss(direction, visibility), coverage);
}

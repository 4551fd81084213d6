// The factors of an object's surface times its maps. A map's define names the texture coordinates it uses: uv or uv1.

#ifdef BASE_COLOUR_MAP
TEXTURE_UNIT(3) uniform sampler2D base_colour_map;
#endif
#ifdef METALLIC_ROUGHNESS_MAP
TEXTURE_UNIT(4) uniform sampler2D metallic_roughness_map;
#endif
#ifdef NORMAL_MAP
TEXTURE_UNIT(5) uniform sampler2D normal_map;
#endif
#ifdef OCCLUSION_MAP
TEXTURE_UNIT(6) uniform sampler2D occlusion_map;
#endif
#ifdef EMISSIVE_MAP
TEXTURE_UNIT(7) uniform sampler2D emissive_map;
#endif

#ifdef TEXTURE_TRANSFORM
vec2 map_coordinates(int map, vec2 coordinates) {
    return uv_linear[map].xy * coordinates.x + uv_linear[map].zw * coordinates.y + uv_offset[map].xy;
}
#else
vec2 map_coordinates(int map, vec2 coordinates) { return coordinates; }
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

vec2 surface_metallic_roughness() {
#ifdef METALLIC_ROUGHNESS_MAP
    return metallic_roughness.xy * texture(metallic_roughness_map, map_coordinates(1, METALLIC_ROUGHNESS_MAP)).bg;
#else
    return metallic_roughness.xy;
#endif
}

// World space, unit, on the side that is seen.
vec3 surface_normal() {
    vec3 n = normalize(world_normal);
#ifdef NORMAL_MAP
    vec3 t = normalize(world_tangent.xyz);
    vec3 b = cross(n, t) * world_tangent.w;
    vec3 bent = texture(normal_map, map_coordinates(2, NORMAL_MAP)).xyz * 2.0 - 1.0;
    bent.xy *= map_strength.x;
    n = normalize(t * bent.x + b * bent.y + n * bent.z);
#endif
#ifdef DOUBLE_SIDED
    if (!gl_FrontFacing) n = -n;
#endif
    return n;
}

float surface_occlusion() {
#ifdef OCCLUSION_MAP
    return 1.0 + map_strength.y * (texture(occlusion_map, map_coordinates(3, OCCLUSION_MAP)).r - 1.0);
#else
    return 1.0;
#endif
}

vec3 surface_emission() {
#ifdef EMISSIVE_MAP
    return mat3(rec709_to_working) * (emissive.rgb * texture(emissive_map, map_coordinates(4, EMISSIVE_MAP)).rgb);
#else
    return emissive.rgb;
#endif
}

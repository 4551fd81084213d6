TEXTURE_UNIT(0) uniform samplerCube environment_map;
TEXTURE_UNIT(1) uniform sampler2D brdf_table;

layout(location = 0) out vec4 radiance;
#ifdef MATERIAL_PASSES_LIGHT
layout(location = 0, index = 1) out vec4 background;  // what lies behind is multiplied by it
#endif

const float PI = 3.14159265358979;

#include "engine/gpu/shaders/half_float.glsl"
#include "engine/render/shaders/surface_maps.glsl"
#if defined(DIRECTIONAL_LIGHTS) || defined(PUNCTUAL_LIGHTS)
#include "engine/render/shaders/direct_light.glsl"
#else
vec3 direct_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness, inout vec3 added) { return vec3(0.0); }
#endif

// Where the light of a GGX lobe comes from in the mean: between the mirror's direction and the normal [Lagarde & de
// Rousiers 2014, 4.9.2]. Prefiltered light has the lobe of a surface seen from in front. Under eight captured probes the
// mirror's direction leaves a white metal of roughness .3, .6, .8 and 1 off by 31, 30, 44 and 51 %, this one by 28, 20, 18
// and 10 % (relative RMS of views up to 80 degrees, measured). Not a unit vector.
vec3 lobe_direction(vec3 n, vec3 v, float roughness) {
    return mix(reflect(-v, n), n, roughness * roughness * roughness);
}

// Between the mirror's level and the first rough one by the lobe's width, which goes with roughness squared.
float environment_level(float roughness) {
    float level = roughness * environment.x;
    return level * min(level, 1.0);
}

#ifdef LOCAL_REFLECTIONS
#include "engine/render/shaders/local_reflection.glsl"
#endif
#ifdef OBJECT_REFLECTIONS
#include "engine/render/shaders/object_reflection.glsl"
#endif

// The environment's light as the scene near the surface hides and replaces it.
vec3 with_surroundings(vec3 light, vec3 direction, float roughness) {
#ifdef AMBIENT_OCCLUSION
    light *= reflection_visibility(abs(dot(direction, normalize(world_normal))), roughness);
#endif
#ifdef LOCAL_REFLECTIONS
    light = with_local_reflection(light, direction, roughness);
#endif
#ifdef OBJECT_REFLECTIONS
    light = with_object_reflection(light, direction, roughness);
#endif
    return light;
}

vec3 environment_light(vec3 direction, float roughness) {
    vec3 light = textureLod(environment_map, direction, environment_level(roughness)).rgb * environment.y;
    return with_surroundings(light, normalize(direction), roughness);
}

#ifdef MATERIAL_HAS_MIRROR
#ifdef MATERIAL_CURVED_MIRROR
TEXTURE_UNIT(18) uniform samplerCube mirror_map;  // the environment with box-filtered levels

// What a mirror shows, averaged over the pixel: a curved one spreads the directions over many texels, and a lamp may be
// one. Uses derivatives: call it in uniform control flow.
vec3 mirrored_light(vec3 direction) {
    return with_surroundings(texture(mirror_map, direction).rgb * environment.y, direction, 0.0);
}
#else
vec3 mirrored_light(vec3 direction) { return environment_light(direction, 0.0); }
#endif
#endif

// A GGX lobe's albedo for reflectance 1 - (1 - cosine)^5 and for (1 - cosine)^5.
vec2 lobe_albedo(float n_v, float roughness) { return texture(brdf_table, vec2(n_v, roughness)).rg; }

#ifdef ROUGH_REFLECTIONS
#include "engine/render/shaders/lobe_nodes.glsl"

// What the lobe reflects of the environment: the light of each part of it, as microfacets at that part's angle do.
vec3 lobe_reflection(vec3 n, vec3 v, vec3 f0, float n_v, float roughness, vec2 split) {
    vec2 position = lobe_position(n_v, roughness);
    vec4 cosines = lobe_cosines(position, n_v, roughness);
    vec4 weights = lobe_weights(position);
    vec4 leans = lobe_leans(position, roughness);
    // Narrower than the first rough level they would show the mirror's sharp lamps.
    vec4 roughnesses = max(lobe_roughnesses(position, roughness), min(roughness, 1.0 / environment.x));
    vec3 mirrored = reflect(-v, n);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 light = environment_light(mix(mirrored, n, leans[i]), roughnesses[i]);
#ifdef MATERIAL_SPECULAR
        sum += weights[i] * reflect_specular(light, f0, cosines[i]);
#else
        sum += weights[i] * light * schlick_reflectance(f0, cosines[i]);
#endif
    }
    return sum * (split.x + split.y);
}
#endif

// `split`: lobe_albedo().
vec3 environment_reflection(vec3 light, vec3 f0, float n_v, float roughness, vec2 split) {
#if defined(MATERIAL_SPECULAR_LOBE)
    return reflect_lobe(light, f0, n_v, roughness, split);
#elif defined(MATERIAL_SPECULAR)
    // The angle at which (1 - cosine)^5 equals its mean over the lobe; a smooth surface has n_v itself, which the
    // table's half floats cannot resolve near normal incidence.
    float albedo = split.x + split.y;
    float cosine = max(n_v, 1.0 - pow(split.y / max(albedo, 1e-6), 0.2));
    return reflect_specular(light, f0, min(cosine, 1.0)) * albedo;
#else
    return (f0 * split.x + split.y) * light;
#endif
}

#ifdef MATERIAL_TRANSMITTANCE
// The part of the light that reaches the diffuse base. Where the surface blends, the base's alpha becomes the fraction
// of what lies behind that is hidden.
vec3 under_transmittance(float n_v, float roughness, inout float alpha) {
    vec3 passing = transmittance(n_v, roughness);
#ifdef ALPHA_BLEND
    vec3 seen = passing * alpha;
    alpha = 1.0 - (1.0 - alpha) * dot(passing, vec3(1.0 / 3.0));
    return seen;
#else
    return passing;
#endif
}
#endif

// The metallic-roughness surface: split sum [Karis 2013] over the prefiltered probe, and the lights, whose part of the
// material's own radiance goes to `added`.
vec3 base_radiance(inout vec4 base_alpha, vec3 n, vec3 v, inout vec3 added) {
    vec3 base = base_alpha.rgb;
    vec2 factors = surface_metallic_roughness();
    float roughness = factors.y;
    vec3 f0 = mix(vec3(0.04), base, factors.x);
    vec3 diffuse = base * (1.0 - factors.x);
    float n_v = max(dot(n, v), 0.0);
#ifdef MATERIAL_TRANSMITTANCE
    diffuse *= under_transmittance(n_v, roughness, base_alpha.a);
#endif
    vec2 split = lobe_albedo(n_v, roughness);
#ifdef ROUGH_REFLECTIONS
    vec3 reflected = lobe_reflection(n, v, f0, n_v, roughness, split);
#else
    vec3 from_lobe = environment_light(lobe_direction(n, v, roughness), roughness);
    vec3 reflected = environment_reflection(from_lobe, f0, n_v, roughness, split);
#endif
#ifdef AMBIENT_AT_VERTICES
    vec3 from_all_sides = ambient_at_vertex;
#else
    vec3 from_all_sides = ambient_light(n);
#endif
    vec3 from_probe = (diffuse * from_all_sides * ambient_visibility() + reflected) * surface_occlusion();
    return from_probe + direct_light(n, v, diffuse, f0, roughness, added);
}

void main() {
    vec4 base = surface_colour();
    vec3 sum = surface_emission();
#ifdef UNLIT
    sum += base.rgb;
#else
    vec3 v = normalize(eye.xyz - world_position);
    vec3 n = seen_normal(surface_normal(), v);
    read_screen_visibility();
    MaterialTerms terms = material_terms();
    sum += terms.base_weight * base_radiance(base, n, v, terms.added);
    sum += terms.added;
#ifdef MATERIAL_HAS_MIRROR
    sum += terms.mirror_weight * mirrored_light(reflect(-v, n));
#endif
#endif
#ifdef MATERIAL_PASSES_LIGHT
    radiance = vec4(sum, 1.0);
    background = vec4(background_weight(), 0.0);
#elif defined(ALPHA_BLEND) && defined(MATERIAL_TRANSMITTANCE)
    radiance = vec4(sum / max(base.a, 1e-4), base.a);  // blending multiplies by alpha; reflections are whole already
#elif defined(ALPHA_BLEND)
    radiance = vec4(sum, base.a);
#else
    radiance = vec4(sum, 1.0);
#endif
    if (shadow.z > 0.0) radiance = rounded_to_half(radiance);
#ifdef ALPHA_MASK
    // Last, as the derivatives that choose mipmap levels are undefined after it.
    if (base.a < metallic_roughness.z) discard;
#endif
}

// The metallic-roughness surface under the scene's lights and the environment, and what the program writes. A material
// includes surface.glsl and environment.glsl, defines what it changes (engine/MODULES.md, "Write the shaders"), then
// includes this file and writes its main().
#include "engine/render/shaders/wear.glsl"

layout(location = 0) out vec4 radiance;
#ifdef MATERIAL_PASSES_LIGHT
layout(location = 0, index = 1) out vec4 background;  // factor of what lies behind
#endif

// What a material adds to, and leaves of, the metallic-roughness surface. Working space.
struct MaterialTerms {
    vec3 base_weight;    // fraction of the light that reaches the metallic-roughness base
    vec3 mirror_weight;  // fraction that is reflected as by a mirror; read only under MATERIAL_HAS_MIRROR
    vec3 added;          // the material's own radiance
};

// The surface at a pixel, and its radiance under the lights that were added.
struct LitSurface {
    vec3 n;
    vec3 v;
    vec3 diffuse;    // over pi
    vec3 f0;
    float alpha2;
    float n_v;       // signed
    float facing;    // n_v, at least 1e-4
    float masking;   // Smith's term of the view
    vec3 radiance;   // without the coat's
#ifdef MATERIAL_COAT
    float coat_alpha2;   // of the layer on top
    float coat_masking;
    vec3 coat;           // its radiance
#endif
};

// GGX with height-correlated Smith visibility [Heitz 2014]. `facing`: the view's cosine; `masking`: its Smith's term;
// `variance`: of the light's directions about their mean, a quarter of its squared radius for a disc. Half vectors turn
// by half as much as the light, so that the middle of a disc's reflection in a mirror has the disc's radiance.
float microfacets(float n_h, float n_l, float alpha2, float facing, float masking, float variance) {
    float n_h2 = n_h * n_h;
    float d = n_h2 * (alpha2 - 1.0) + 1.0 + variance * n_h2;
    float shadowing = n_l * masking + facing * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2);
    return 0.5 / PI * (alpha2 + variance) / (d * d * max(shadowing, 1e-6));
}

// Adds the reflection of a light of this irradiance, measured on a surface that faces it. l and v are unit vectors, so
// |l + v|² = 2 + 2 l·v. `variance`: microfacets().
void add_light(vec3 irradiance, vec3 l, float variance, inout LitSurface surface) {
    float v_l = dot(surface.v, l);
    float inverse_length = inversesqrt(max(2.0 + 2.0 * v_l, 1e-12));
    float n_l = dot(surface.n, l);
    float n_h = clamp((n_l + surface.n_v) * inverse_length, 0.0, 1.0);
    float v_h = clamp((1.0 + v_l) * inverse_length, 0.0, 1.0);
    n_l = max(n_l, 0.0);
#ifdef WEAR_MAP
    wear_light(irradiance, n_l, l, surface.v, variance);
#endif
    float density = microfacets(n_h, n_l, surface.alpha2, surface.facing, surface.masking, variance);
#ifdef MATERIAL_COAT
    surface.coat += microfacets(n_h, n_l, surface.coat_alpha2, surface.facing, surface.coat_masking, variance) *
                    coat_reflectance(v_h) * n_l * irradiance;
#endif
#ifdef MATERIAL_SPECULAR
    vec3 specular = reflect_specular(irradiance, surface.f0, v_h) * density;
    surface.radiance += (surface.diffuse * irradiance + specular) * n_l;
#else
    vec3 fresnel = schlick_reflectance(surface.f0, v_h);
    surface.radiance += (surface.diffuse + fresnel * density) * n_l * irradiance;
#endif
}

#if defined(DIRECTIONAL_LIGHTS) || defined(PUNCTUAL_LIGHTS)
// Radiance of the metallic-roughness base under the lights. The radiance of the material and of its coat goes to
// `added`.
vec3 direct_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness, inout vec3 added) {
    float alpha2 = max(roughness * roughness * roughness * roughness, 1e-6);
    float n_v = dot(n, v);
    float facing = max(n_v, 1e-4);
    float masking = sqrt(facing * facing * (1.0 - alpha2) + alpha2);
#ifdef MATERIAL_COAT
    float coat_alpha2 = pow(max(coat_roughness(), 0.04), 4.0);
    LitSurface surface =
        LitSurface(n, v, diffuse / PI, f0, alpha2, n_v, facing, masking, vec3(0.0), coat_alpha2,
                   sqrt(facing * facing * (1.0 - coat_alpha2) + coat_alpha2), vec3(0.0));
#else
    LitSurface surface = LitSurface(n, v, diffuse / PI, f0, alpha2, n_v, facing, masking, vec3(0.0));
#endif
#ifdef DIRECTIONAL_LIGHTS
#ifdef SEVERAL_DIRECTIONAL_LIGHTS
    int directional = int(light_counts.x);
#else
    const int directional = 1;  // most scenes have one sun: a loop of unknown length costs a quarter of the frame
#endif
    for (int i = 0; i < directional; ++i) {
        float visibility = 1.0;
#ifdef SHADOWS
        if (i == 0) visibility = shadow_visibility(lights[i].position.xyz);
#endif
        float variance = lights[i].strength.w;
        add_light(visibility * lights[i].strength.rgb, lights[i].position.xyz, variance, surface);
#ifdef MATERIAL_DIRECTIONAL_LIGHTS
        material_light(i, visibility, lights[i].position.xyz, variance, added);
#endif
    }
#endif
#ifdef PUNCTUAL_LIGHTS
    for (int i = int(light_counts.x); i < int(light_counts.y); ++i) {
        vec3 to_light = lights[i].position.xyz - world_position;
        float distance2 = dot(to_light, to_light);
        float inverse = inversesqrt(max(distance2, 1e-8));
        vec3 l = to_light * inverse;
        float attenuation = punctual_attenuation(lights[i], distance2, inverse, l);
        float variance = lights[i].strength.w * inverse * inverse;
        add_light(attenuation * lights[i].strength.rgb, l, variance, surface);
#ifdef MATERIAL_PUNCTUAL_LIGHTS
        material_light(i, attenuation, l, variance, added);
#endif
    }
#endif
#ifdef MATERIAL_COAT
    added += surface.coat;
#endif
    return surface.radiance;
}
#else
vec3 direct_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness, inout vec3 added) { return vec3(0.0); }
#endif

#ifdef WEAR_MAP
vec3 lobe_light = vec3(0.0);  // the environment's light over the lobe, set by lobe_reflection()
#endif

// The lobe's reflection of the environment. `dfg`: split_sum_dfg().
#ifdef ROUGH_REFLECTIONS
// Sum over the lobe's nodes: the light of a node times the reflectance of microfacets at its angle.
vec3 lobe_reflection(vec3 n, vec3 v, vec3 f0, float n_v, float roughness, vec2 dfg) {
    LobeNodes nodes = lobe_nodes(n_v, roughness);
    // Look-ups below the first rough level would show sharp lamps, as a mirror does.
    vec4 roughnesses = max(nodes.roughnesses, min(roughness, 1.0 / environment.x));
    vec3 mirrored = reflect(-v, n);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec3 light = environment_light(mix(mirrored, n, nodes.leans[i]), roughnesses[i]);
#ifdef WEAR_MAP
        lobe_light += nodes.weights[i] * light;
#endif
#ifdef MATERIAL_SPECULAR
        sum += nodes.weights[i] * reflect_specular(light, f0, nodes.cosines[i]);
#else
        sum += nodes.weights[i] * light * schlick_reflectance(f0, nodes.cosines[i]);
#endif
    }
    return sum * (dfg.x + dfg.y);
}
#else
vec3 lobe_reflection(vec3 n, vec3 v, vec3 f0, float n_v, float roughness, vec2 dfg) {
    vec3 light = environment_light(lobe_direction(n, v, roughness), roughness);
#ifdef WEAR_MAP
    lobe_light = light;
#endif
#if defined(MATERIAL_SPECULAR_LOBE)
    return reflect_lobe(light, f0, n_v, roughness, dfg);
#elif defined(MATERIAL_SPECULAR)
    // The angle at which (1 - cosine)^5 equals its mean over the lobe; a smooth surface has n_v itself, which the
    // table's half floats cannot resolve near normal incidence.
    float albedo = dfg.x + dfg.y;
    float cosine = max(n_v, 1.0 - pow(dfg.y / max(albedo, 1e-6), 0.2));
    return reflect_specular(light, f0, min(cosine, 1.0)) * albedo;
#else
    return (f0 * dfg.x + dfg.y) * light;
#endif
}
#endif

vec3 diffuse_probe_light(vec3 n) {
#ifdef AMBIENT_AT_VERTICES
    return ambient_at_vertex * ambient_visibility();
#else
    return ambient_light(n) * ambient_visibility();
#endif
}

// The metallic-roughness surface under the prefiltered probe, by the split sum [Karis 2013], and under the lights,
// whose part of the material's own radiance goes to `added`. `base`: colour and alpha; under a blended material with a
// transmittance, alpha becomes the fraction of what lies behind that is hidden.
vec3 base_radiance(inout vec4 base, vec3 n, vec3 v, inout vec3 added) {
    vec2 factors = surface_metallic_roughness();
    float roughness = seen_roughness(factors.y, n);
#ifdef WEAR_MAP
    roughness = mix(roughness, max(roughness, GREASE_ROUGHNESS), wear.grease);
#endif
    vec3 f0 = mix(vec3(0.04), base.rgb, factors.x);
    vec3 diffuse = base.rgb * (1.0 - factors.x);
    float n_v = max(dot(n, v), 0.0);
#ifdef MATERIAL_TRANSMITTANCE
    vec3 passing = transmittance(n_v, roughness);
#ifdef ALPHA_BLEND
    diffuse *= passing * base.a;
    base.a = 1.0 - (1.0 - base.a) * dot(passing, vec3(1.0 / 3.0));
#else
    diffuse *= passing;
#endif
#endif
    vec3 reflected = lobe_reflection(n, v, f0, n_v, roughness, split_sum_dfg(n_v, roughness));
    vec3 from_probe = (diffuse * diffuse_probe_light(n) + reflected) * surface_occlusion();
    return from_probe + direct_light(n, v, diffuse, f0, roughness, added);
}

#ifdef WEAR_MAP
// Reflectance of white light by the metallic-roughness base; material_reflectance(): by the material's orders or
// mirror.
vec3 base_reflectance(vec3 colour, float n_v) {
    vec3 f0 = mix(vec3(0.04), colour, surface_metallic_roughness().x);
#ifdef MATERIAL_SPECULAR
    return reflect_specular(vec3(1.0), f0, n_v);
#else
    return schlick_reflectance(f0, n_v);
#endif
}
#ifndef MATERIAL_REFLECTANCE
vec3 material_reflectance() { return vec3(0.0); }
#endif

// The material's own light under grease: the part that grease covers is replaced by the material's reflectance of the
// light over the base's lobe, which grease has made rough.
vec3 greased(vec3 added) { return mix(added, material_reflectance() * lobe_light, wear.grease); }
#endif

// Writes the surface with the material's terms. main() begins with read_screen_visibility() and ends with this.
void write_surface(MaterialTerms terms) {
    vec4 base = surface_colour();
    vec3 sum = surface_emission();
#ifdef UNLIT
    sum += base.rgb;
#else
    vec3 v = to_eye();
    vec3 n = seen_normal(surface_normal(), v);
#ifdef WEAR_MAP
    read_wear(n, terms.base_weight * base_reflectance(base.rgb, max(dot(n, v), 0.0)) + material_reflectance());
#endif
    sum += terms.base_weight * base_radiance(base, n, v, terms.added);
#ifdef WEAR_MAP
    sum += greased(terms.added);
#else
    sum += terms.added;
#endif
#ifdef MATERIAL_HAS_MIRROR
#ifdef WEAR_MAP
    terms.mirror_weight *= 1.0 - wear.grease;
#endif
    sum += terms.mirror_weight * mirrored_light(reflect(-v, n), n);
#endif
#ifdef WEAR_MAP
    sum = worn(sum, n, v, diffuse_probe_light(n));
#ifdef ALPHA_BLEND
    base.a = mix(base.a, 1.0, wear.dust);
#endif
#endif
#endif
    float alpha = base.a;
#if defined(MATERIAL_PASSES_LIGHT)
    radiance = vec4(sum, 1.0);
#ifdef WEAR_MAP
    background = vec4((1.0 - wear.dust) * (1.0 - wear.grease) * background_weight(), 0.0);
#else
    background = vec4(background_weight(), 0.0);
#endif
#elif defined(ALPHA_BLEND) && defined(MATERIAL_TRANSMITTANCE)
    radiance = vec4(sum / max(alpha, 1e-4), alpha);  // blending multiplies by alpha; reflections are whole already
#elif defined(ALPHA_BLEND)
    radiance = vec4(sum, alpha);
#else
    radiance = vec4(sum, 1.0);
#endif
#ifdef LIGHT_PART
    radiance.rgb *= light_part.x;
#endif
    if (shadow.z > 0.0) radiance = rounded_to_half(radiance);
#ifdef ALPHA_MASK
    if (alpha < metallic_roughness.z) discard;  // last: derivatives are undefined after it
#endif
}

// The scene's lights on a GGX surface. Defines: DIRECTIONAL_LIGHTS, SEVERAL_DIRECTIONAL_LIGHTS, PUNCTUAL_LIGHTS, SHADOWS
// (of the first directional light), SOFT_SHADOWS.
#include "engine/render/shaders/light_block.h"

// The engine's surface at a pixel, and what it reflects of all lights.
struct LitSurface {
    vec3 n;
    vec3 v;
    vec3 diffuse;    // over pi
    vec3 f0;
    float alpha2;
    float n_v;       // signed
    float facing;    // n_v above 0
    float masking;   // Smith's term of the view
    vec3 radiance;
#ifdef MATERIAL_GLOSS
    float gloss_alpha2;   // of the layer on top
    float gloss_masking;
    vec3 gloss;           // what it reflects
#endif
};

// GGX with height-correlated Smith visibility [Heitz 2014]. `facing`: the view's cosine; `masking`: its Smith's term.
float microfacets(float n_h, float n_l, float alpha2, float facing, float masking) {
    float d = n_h * n_h * (alpha2 - 1.0) + 1.0;
    float shadowing = n_l * masking + facing * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2);
    return 0.5 / PI * alpha2 / (d * d * max(shadowing, 1e-6));
}

// Adds what the surface reflects of a light of this irradiance (on what faces it). l and v are unit vectors, so
// |l + v|² = 2 + 2 l·v.
void add_light(vec3 irradiance, vec3 l, inout LitSurface surface) {
    float v_l = dot(surface.v, l);
    float inverse_length = inversesqrt(max(2.0 + 2.0 * v_l, 1e-12));
    float n_l = dot(surface.n, l);
    float n_h = clamp((n_l + surface.n_v) * inverse_length, 0.0, 1.0);
    float v_h = clamp((1.0 + v_l) * inverse_length, 0.0, 1.0);
    n_l = max(n_l, 0.0);
    float density = microfacets(n_h, n_l, surface.alpha2, surface.facing, surface.masking);
#ifdef MATERIAL_GLOSS
    surface.gloss += microfacets(n_h, n_l, surface.gloss_alpha2, surface.facing, surface.gloss_masking) *
                     gloss_reflectance(v_h) * n_l * irradiance;
#endif
#ifdef MATERIAL_SPECULAR
    vec3 specular = reflect_specular(irradiance, surface.f0, v_h) * density;
    surface.radiance += (surface.diffuse * irradiance + specular) * n_l;
#else
    vec3 fresnel = schlick_reflectance(surface.f0, v_h);
    surface.radiance += (surface.diffuse + fresnel * density) * n_l * irradiance;
#endif
}

#ifdef SHADOWS
#ifdef SOFT_SHADOWS
#include "engine/render/shaders/soft_shadow.glsl"
#else
TEXTURE_UNIT(2) uniform sampler2DShadow shadow_map;
#endif

// Four filtered comparisons half a texel apart reach 1.5 texels along each axis. Within that reach, a plane lies at most
// 1.5 sqrt(2) texels * tan(angle to the light) nearer to the light than at the point; a point lifted by as many texels
// times the sine stays above it.
const float SHADOW_LIFT = 2.2;

// A point of a surface of normal n, toward the light, in the map.
vec3 shadow_coordinates(vec3 position, vec3 n, vec3 l) {
    vec3 lifted = position + n * (SHADOW_LIFT * shadow.x * length(cross(n, l)));
    vec3 at = (world_to_shadow * vec4(lifted, 1.0)).xyz * 0.5 + 0.5;
    at.z = min(at.z, 1.0);  // behind everything that casts a shadow
    return at;
}

// One filtered comparison.
float shadow_tap(vec3 at) {
#ifdef SOFT_SHADOWS
    return lit_fraction(at.xy, at.z);
#else
    return texture(shadow_map, at);
#endif
}

// Fraction of the first directional light that reaches the pixel.
float shadow_visibility(vec3 l) {
    vec3 n = normalize(world_normal);
    if (dot(n, l) < 0.0) n = -n;
    vec3 at = shadow_coordinates(world_position, n, l);
#ifdef SOFT_SHADOWS
    float lit = disc_visibility(at, n);
#else
    vec2 half_texel = vec2(0.5, -0.5) * shadow.y;
    float lit =
        0.25 * (shadow_tap(vec3(at.xy + half_texel.xx, at.z)) + shadow_tap(vec3(at.xy + half_texel.xy, at.z)) +
                shadow_tap(vec3(at.xy + half_texel.yx, at.z)) + shadow_tap(vec3(at.xy + half_texel.yy, at.z)));
#endif
    return contact_visibility() * lit;
}
#endif

// glTF's KHR_lights_punctual: inverse square, a window at the range, a spot's cone. `inverse`: 1 / distance.
float punctual_attenuation(Light light, float distance2, float inverse, vec3 l) {
    float window = clamp(1.0 - distance2 * distance2 * light.position.w, 0.0, 1.0);
    float cone = clamp(light.axis.w - dot(light.axis.xyz, l), 0.0, 1.0) * inverse;
    return window * cone * cone;
}

// What the surface reflects. `added`: radiance of the material's own, to which it and a layer on top add their parts of
// the lights.
vec3 direct_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness, inout vec3 added) {
    float alpha2 = max(roughness * roughness * roughness * roughness, 1e-6);
    float n_v = dot(n, v);
    float facing = max(n_v, 1e-4);
    float masking = sqrt(facing * facing * (1.0 - alpha2) + alpha2);
#ifdef MATERIAL_GLOSS
    float gloss_alpha2 = pow(max(gloss_roughness(), 0.04), 4.0);
    LitSurface surface =
        LitSurface(n, v, diffuse / PI, f0, alpha2, n_v, facing, masking, vec3(0.0), gloss_alpha2,
                   sqrt(facing * facing * (1.0 - gloss_alpha2) + gloss_alpha2), vec3(0.0));
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
        add_light(visibility * lights[i].strength.rgb, lights[i].position.xyz, surface);
#ifdef MATERIAL_DIRECTIONAL_LIGHTS
        material_light(i, visibility, lights[i].position.xyz, added);
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
        add_light(attenuation * lights[i].strength.rgb, l, surface);
#ifdef MATERIAL_PUNCTUAL_LIGHTS
        material_light(i, attenuation, l, added);
#endif
    }
#endif
#ifdef MATERIAL_GLOSS
    added += surface.gloss;
#endif
    return surface.radiance;
}

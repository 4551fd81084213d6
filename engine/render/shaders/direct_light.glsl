// The scene's lights on a GGX surface. Defines: DIRECTIONAL_LIGHTS, SEVERAL_DIRECTIONAL_LIGHTS, PUNCTUAL_LIGHTS, SHADOWS
// (of the first directional light).
#include "engine/render/shaders/light_block.h"

// Radiance that a light of this irradiance (on a surface that faces it) leaves toward v: GGX with height-correlated
// Smith visibility [Heitz 2014].
vec3 reflected_radiance(vec3 irradiance, vec3 l, vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness) {
    vec3 h = normalize(l + v);
    float n_l = max(dot(n, l), 0.0);
    float n_v = max(dot(n, v), 1e-4);
    float n_h = clamp(dot(n, h), 0.0, 1.0);
    float v_h = clamp(dot(v, h), 0.0, 1.0);
    float alpha2 = max(roughness * roughness * roughness * roughness, 1e-6);
    float d = n_h * n_h * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (PI * d * d);
    float shadowing = n_l * sqrt(n_v * n_v * (1.0 - alpha2) + alpha2) + n_v * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2);
#ifdef MATERIAL_SPECULAR
    vec3 specular = reflect_specular(irradiance, f0, v_h) * distribution * 0.5 / max(shadowing, 1e-6);
    return (diffuse / PI * irradiance + specular) * n_l;
#else
    vec3 fresnel = schlick_reflectance(f0, v_h);
    return (diffuse / PI + fresnel * distribution * 0.5 / max(shadowing, 1e-6)) * n_l * irradiance;
#endif
}

#ifdef SHADOWS
layout(binding = 2) uniform sampler2DShadow shadow_map;

// Four filtered comparisons half a texel apart reach 1.5 texels along each axis. Within that reach, a plane lies at most
// 1.5 sqrt(2) texels * tan(angle to the light) nearer to the light than at the point; a point lifted by as many texels
// times the sine stays above it.
const float SHADOW_LIFT = 2.2;

// Fraction of the first directional light that reaches the point.
float shadow_visibility(vec3 l) {
    vec3 n = normalize(world_normal);
    if (dot(n, l) < 0.0) n = -n;
    vec3 lifted = world_position + n * (SHADOW_LIFT * shadow.x * length(cross(n, l)));
    vec3 at = (world_to_shadow * vec4(lifted, 1.0)).xyz * 0.5 + 0.5;
    at.z = min(at.z, 1.0);  // behind everything that casts a shadow
    vec2 half_texel = vec2(0.5, -0.5) * shadow.y;
    return 0.25 * (texture(shadow_map, vec3(at.xy + half_texel.xx, at.z)) +
                   texture(shadow_map, vec3(at.xy + half_texel.xy, at.z)) +
                   texture(shadow_map, vec3(at.xy + half_texel.yx, at.z)) +
                   texture(shadow_map, vec3(at.xy + half_texel.yy, at.z)));
}
#endif

// glTF's KHR_lights_punctual: inverse square, a window at the range, a spot's cone.
float punctual_attenuation(Light light, float distance2, vec3 l) {
    float window = clamp(1.0 - distance2 * distance2 * light.position.w, 0.0, 1.0);
    float cone = 1.0;
    if (light.axis.w > 0.0) cone = clamp(dot(light.axis.xyz, -l) * light.cone.x + light.cone.y, 0.0, 1.0);
    return window * cone * cone / max(distance2, 1e-8);
}

vec3 direct_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness) {
    vec3 sum = vec3(0.0);
#ifdef DIRECTIONAL_LIGHTS
#ifdef SEVERAL_DIRECTIONAL_LIGHTS
    int directional = int(light_counts.x);
#else
    const int directional = 1;  // most scenes have one sun: a loop of unknown length costs a quarter of the frame
#endif
    for (int i = 0; i < directional; ++i) {
        vec3 irradiance = lights[i].strength.rgb;
#ifdef SHADOWS
        if (i == 0) irradiance *= shadow_visibility(lights[i].position.xyz);
#endif
        sum += reflected_radiance(irradiance, lights[i].position.xyz, n, v, diffuse, f0, roughness);
    }
#endif
#ifdef PUNCTUAL_LIGHTS
    for (int i = int(light_counts.x); i < int(light_counts.y); ++i) {
        vec3 to_light = lights[i].position.xyz - world_position;
        float distance2 = dot(to_light, to_light);
        vec3 l = to_light * inversesqrt(max(distance2, 1e-12));
        vec3 irradiance = punctual_attenuation(lights[i], distance2, l) * lights[i].strength.rgb;
        sum += reflected_radiance(irradiance, l, n, v, diffuse, f0, roughness);
    }
#endif
    return sum;
}

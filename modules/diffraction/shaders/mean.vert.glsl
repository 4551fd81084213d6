#version 450 core
// A grating of one colour for all views: the light that a vertex gets.
#include "engine/render/shaders/vertex.glsl"

out vec3 irradiance;  // over pi; working space
#ifdef SHADOWS
out vec3 shadowed;  // the part of the light that casts shadows
#endif

// Of a directional light, or a point's or a spot's.
vec3 light_irradiance(Light light, bool directional, vec3 position, vec3 n) {
    vec3 to_light = directional ? light.position.xyz : light.position.xyz - position;
    float distance2 = dot(to_light, to_light);
    float inverse = inversesqrt(max(distance2, 1e-8));
    vec3 l = to_light * inverse;
    float attenuation = directional ? 1.0 : punctual_attenuation(light, distance2, inverse, l);
    return (max(dot(n, l), 0.0) * attenuation / 3.14159265358979) * light.strength.rgb;
}

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
#ifdef DOUBLE_SIDED
    if (dot(n, eye.xyz - position) < 0.0) n = -n;
#endif
    irradiance = ambient_light(n);
#if defined(DIRECTIONAL_LIGHTS) || defined(PUNCTUAL_LIGHTS)
    for (int i = 0; i < int(light_counts.y); ++i) {
        vec3 added = light_irradiance(lights[i], i < int(light_counts.x), position, n);
#ifdef SHADOWS
        if (i == 0) {
            shadowed = added;
            continue;
        }
#endif
        irradiance += added;
    }
#endif
}

#version 450 core
// A grating of one colour for all views, the mean over them: a matte surface that reflects as much light.
#include "engine/render/shaders/surface.glsl"

in vec3 irradiance;
#ifdef SHADOWS
in vec3 shadowed;
#endif

uniform vec3 base_weight;
uniform vec3 reflectance;  // of all orders

layout(location = 0) out vec4 radiance;

void main() {
    read_screen_visibility();
    vec4 base = surface_colour();
    vec3 sum = surface_emission();
#ifdef UNLIT
    sum += base.rgb;
#else
    vec3 light = ambient_visibility() * surface_occlusion() * irradiance;
#ifdef SHADOWS
    light += shadow_visibility(lights[0].position.xyz) * shadowed;
#endif
    sum += (base_weight * base.rgb + reflectance) * light;
#endif
    radiance = vec4(sum, base.a);
#ifdef LIGHT_PART
    radiance.rgb *= light_part.x;
#endif
    if (shadow.z > 0.0) radiance = rounded_to_half(radiance);
#ifdef ALPHA_MASK
    if (base.a < metallic_roughness.z) discard;
#endif
}

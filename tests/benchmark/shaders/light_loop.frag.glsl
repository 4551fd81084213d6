#version 450 core
// A grating of flat lobe under directional lights, light by light and order by order. ORDERS is defined by the program.
#define MATERIAL_HAS_MIRROR
#include "engine/render/shaders/forward_fragment_interface.glsl"
#include "engine/render/shaders/light_block.h"

in vec3 world_grating;

// Row 3k + c: d/|m| times efficiency, light and observer for order k's light of colour c, a texel a nanometre from 380.
layout(binding = 8) uniform sampler2D order_colours;
uniform int orders[ORDERS];
uniform float pitch_nm;
uniform mat3 working_to_rec709;
uniform vec3 mirror_weight;
uniform vec3 base_weight;

vec3 order_xyz(int k, float path_nm, vec3 flux) {
    float wavelength_nm = path_nm / float(orders[k]);
    if (wavelength_nm < 380.0 || wavelength_nm > 780.0) return vec3(0.0);
    float s = (wavelength_nm - 380.0 + 0.5) / 401.0;
    float row = 3.0 * float(k) + 0.5;
    const float rows = 3.0 * float(ORDERS);
    return flux.r * textureLod(order_colours, vec2(s, row / rows), 0.0).xyz +
           flux.g * textureLod(order_colours, vec2(s, (row + 1.0) / rows), 0.0).xyz +
           flux.b * textureLod(order_colours, vec2(s, (row + 2.0) / rows), 0.0).xyz;
}

MaterialTerms material_terms() {
    vec3 n = normalize(world_normal);
    vec3 g = normalize(world_grating - n * dot(n, world_grating));
    vec3 v = normalize(eye.xyz - world_position);
    vec3 xyz = vec3(0.0);
    if (dot(n, v) > 0.0) {
        for (int i = 0; i < int(light_counts.x); ++i) {
            vec3 s = lights[i].place.xyz;
            float cosine = max(dot(n, s), 0.0);
            vec3 flux = working_to_rec709 * lights[i].strength.rgb;
            for (int k = 0; k < ORDERS; ++k) xyz += 0.5 * cosine * order_xyz(k, pitch_nm * (dot(g, s) + dot(g, v)), flux);
        }
    }
    return MaterialTerms(base_weight, mirror_weight, mat3(xyz_to_working) * xyz);
}

#include "engine/render/shaders/forward_fragment_main.glsl"

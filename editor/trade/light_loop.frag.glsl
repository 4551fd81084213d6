#version 450 core
// Shades each light and each order separately: the slow method of the paper's fig. 3.
#define MATERIAL_HAS_MIRROR
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"
#include "modules/diffraction/shaders/grooves.glsl"
#include "engine/render/shaders/shading.glsl"

struct LoopLight {
    vec4 direction;   // xyz: unit, world, toward the light
    vec4 irradiance;  // xyz: on a surface that faces it, linear Rec.709
};
layout(std430, binding = 4) readonly buffer LoopLights { LoopLight loop_lights[]; };
layout(binding = 8) uniform sampler2D colour_rows;
uniform int light_count;
uniform int order_count;
uniform float orders[64];
uniform float pitch_nm;
uniform vec3 mirror_weight;
uniform vec3 base_weight;

// XYZ that order i adds for light `rgb`, at the path difference `path_nm` between neighbouring grooves.
vec3 order_xyz(int i, float path_nm, vec3 rgb) {
    float wavelength_nm = path_nm / orders[i];
    if (wavelength_nm < 380.0 || wavelength_nm > 780.0) return vec3(0.0);
    float s = (wavelength_nm - 380.0 + 0.5) / 401.0;
    float rows = 3.0 * float(order_count);
    vec3 xyz = vec3(0.0);
    for (int c = 0; c < 3; ++c) xyz += rgb[c] * textureLod(colour_rows, vec2(s, (float(3 * i + c) + 0.5) / rows), 0.0).xyz;
    return xyz;
}

void main() {
    read_screen_visibility();
    GrooveView view = groove_view();
    vec3 xyz = vec3(0.0);
    if (view.direction.z > 0.0)
        for (int i = 0; i < light_count; ++i) {
            vec3 s = loop_lights[i].direction.xyz * view.axes;
            if (s.z <= 0.0) continue;
            for (int o = 0; o < order_count; ++o)
                xyz += s.z * order_xyz(o, pitch_nm * (s.x + view.direction.x), loop_lights[i].irradiance.rgb);
        }
    write_surface(MaterialTerms(base_weight, mirror_weight, mat3(xyz_to_working) * xyz));
}

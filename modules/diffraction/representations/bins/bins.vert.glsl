#version 450 core
// Fixed wavelength bins: bin_table.h. BANDS, BINS and VIEW_MAPPING are defined by the program.
#include "engine/render/shaders/forward_vertex_interface.glsl"
#include "modules/diffraction/shaders/tangent_light.glsl"
#include "modules/diffraction/shaders/packed_table.glsl"

const int LAYERS = (COEFFICIENTS + 3) / 4;

uniform vec3 bin_colours[3 * BINS];  // XYZ of red, green and blue light, bin by bin

vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    vec2 coordinates = table_coordinates(view);
    vec3 light[COEFFICIENTS];
    for (int i = 0; i < COEFFICIENTS; ++i) light[i] = light_coefficient(i);
    vec3 xyz = vec3(0.0);
    for (int b = 0; b < BINS; ++b) {
        vec3 rgb = vec3(0.0);
        for (int j = 0; j < LAYERS; ++j) {
            vec4 entries = table_entries(coordinates, b * LAYERS + j);
            for (int e = 0; e < 4 && 4 * j + e < COEFFICIENTS; ++e) rgb += entries[e] * light[4 * j + e];
        }
        xyz += rgb.r * bin_colours[3 * b] + rgb.g * bin_colours[3 * b + 1] + rgb.b * bin_colours[3 * b + 2];
    }
    return mat3(xyz_to_working) * xyz;
}

#include "modules/diffraction/shaders/vertex_shaded.glsl"
#include "engine/render/shaders/forward_vertex_main.glsl"

// SH coefficients with the wavelengths summed: transfer_table.h. BANDS and VIEW_MAPPING are defined by the program.
#include "modules/diffraction/shaders/view_table.glsl"

const int LAYERS = (COEFFICIENTS + 3) / 4;

vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    vec2 coordinates = table_coordinates(view);
    vec3 xyz = vec3(0.0);
    for (int j = 0; j < LAYERS; ++j) {
        mat4x3 light = mat4x3(0.0);  // column e: RGB of coefficient 4j+e
        for (int e = 0; e < 4 && 4 * j + e < COEFFICIENTS; ++e) light[e] = light_coefficient(4 * j + e);
        mat3x4 by_colour = transpose(light);
        for (int c = 0; c < 3; ++c)
            for (int o = 0; o < 3; ++o)
                xyz[o] += dot(table_entries(coordinates, (c * 3 + o) * LAYERS + j), by_colour[c]);
    }
    return mat3(xyz_to_working) * xyz;
}

// The rendering steps of Lindsay & Agu 2006, fig. 5, numbered as there. BANDS, SPIKES and VIEW_MAPPING are defined by the
// program. The CPU does steps 1 and 2, the light's rotation to the vertices.
#include "modules/diffraction/shaders/view_table.glsl"

const int LAYERS = (COEFFICIENTS + 1 + 3) / 4;

// XYZ of a spike of coefficient 1 under red, then under green, then under blue light, one texel per nanometre from 380 to
// 780. A line: rows of a plane would be filtered across.
TEXTURE_UNIT(9) uniform SAMPLER_LINE wavelength_table;

vec3 wavelength_to_xyz(float normalised, vec3 rgb) {
    float s = (clamp(normalised, 0.0, 1.0) * 400.0 + 0.5) / 1203.0;
    return rgb.r * LINE_LOD(wavelength_table, s, 0.0).xyz +
           rgb.g * LINE_LOD(wavelength_table, s + 1.0 / 3.0, 0.0).xyz +
           rgb.b * LINE_LOD(wavelength_table, s + 2.0 / 3.0, 0.0).xyz;
}

// Layer k*LAYERS + j of the table: entries 4j..4j+3 of spike k's [c_0 ... c_(n*n-1), (wavelength - 380) / 400].
vec3 spike_xyz(int spike, vec2 coordinates, vec3 light[COEFFICIENTS]) {
    vec3 rgb = vec3(0.0);
    float normalised_wavelength = 0.0;
    for (int j = 0; j < LAYERS; ++j) {
        vec4 entries = table_entries(coordinates, spike * LAYERS + j);  // steps 4 and 5: look up, scale and bias
        for (int e = 0; e < 4; ++e) {
            int i = 4 * j + e;
            if (i < COEFFICIENTS) rgb += entries[e] * light[i];  // step 6
            if (i == COEFFICIENTS) normalised_wavelength = entries[e];
        }
    }
    return wavelength_to_xyz(normalised_wavelength, rgb);  // step 7
}

vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    vec2 coordinates = table_coordinates(view);  // step 3
    vec3 light[COEFFICIENTS];
    for (int i = 0; i < COEFFICIENTS; ++i) light[i] = light_coefficient(i);
    vec3 xyz = vec3(0.0);
    for (int k = 0; k < SPIKES; ++k) xyz += spike_xyz(k, coordinates, light);
    return mat3(xyz_to_working) * xyz;
}

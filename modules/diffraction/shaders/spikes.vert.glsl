#version 450 core
// The rendering steps of Lindsay & Agu 2006, fig. 5, numbered as there. BANDS and SPIKES are defined by the program.
#include "engine/render/shaders/forward_vertex_interface.glsl"

const int COEFFICIENTS = BANDS * BANDS;
const int LAYERS = (COEFFICIENTS + 1 + 3) / 4;
const float HALF_PI = 1.57079632679490;

// Steps 1 and 2: the light's SH, rotated to each vertex's tangent frame on the CPU. RGB after RGB.
layout(std430, binding = 4) readonly buffer TangentLight { float tangent_light[]; };
// Scale and bias of each layer of the table, one after the other.
layout(std430, binding = 5) readonly buffer TableRange { vec4 table_range[]; };

// Layer k*LAYERS + j: entries 4j..4j+3 of spike k's [c_0 ... c_(n*n-1), (wavelength - 380) / 400].
layout(binding = 4) uniform sampler2DArray spike_table;
// Row c: XYZ of E_c(wavelength), one texel a nanometre from 380 to 780.
layout(binding = 5) uniform sampler2D wavelength_table;

out vec3 diffracted;

vec3 light_coefficient(int i) {
    int at = 3 * (gl_VertexID * COEFFICIENTS + i);
    return vec3(tangent_light[at], tangent_light[at + 1], tangent_light[at + 2]);
}

// Spherical mapping of the view. Behind the horizon it stays at the rim: such vertices are seen only as the far end of a
// triangle that crosses the silhouette.
vec2 view_coordinates(vec3 view) {
    vec2 nodes = vec2(textureSize(spike_table, 0).xy);
    float theta = min(atan(length(view.xy), view.z), HALF_PI);
    float phi = view.x == 0.0 && view.y == 0.0 ? 0.0 : atan(view.y, view.x);
    return vec2(phi / (4.0 * HALF_PI) + 0.5 / nodes.x, (theta / HALF_PI * (nodes.y - 1.0) + 0.5) / nodes.y);
}

vec3 wavelength_to_xyz(float normalised, vec3 rgb) {
    float s = (clamp(normalised, 0.0, 1.0) * 400.0 + 0.5) / 401.0;
    return rgb.r * texture(wavelength_table, vec2(s, 0.5 / 3.0)).xyz +
           rgb.g * texture(wavelength_table, vec2(s, 1.5 / 3.0)).xyz +
           rgb.b * texture(wavelength_table, vec2(s, 2.5 / 3.0)).xyz;
}

vec3 spike_xyz(int spike, vec2 coordinates, vec3 light[COEFFICIENTS]) {
    vec3 rgb = vec3(0.0);
    float normalised_wavelength = 0.0;
    for (int j = 0; j < LAYERS; ++j) {
        int layer = spike * LAYERS + j;
        // Steps 4 and 5: look up, scale and bias.
        vec4 stored = textureLod(spike_table, vec3(coordinates, layer), 0.0);
        vec4 entries = stored * table_range[2 * layer] + table_range[2 * layer + 1];
        for (int e = 0; e < 4; ++e) {
            int i = 4 * j + e;
            if (i < COEFFICIENTS) rgb += entries[e] * light[i];  // step 6
            if (i == COEFFICIENTS) normalised_wavelength = entries[e];
        }
    }
    return wavelength_to_xyz(normalised_wavelength, rgb);  // step 7
}

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {
    vec3 v = normalize(eye.xyz - position);
    vec3 view = vec3(dot(v, g), dot(v, h), dot(v, n));  // step 3
    vec2 coordinates = view_coordinates(view);
    vec3 light[COEFFICIENTS];
    for (int i = 0; i < COEFFICIENTS; ++i) light[i] = light_coefficient(i);
    vec3 xyz = vec3(0.0);
    for (int k = 0; k < SPIKES; ++k) xyz += spike_xyz(k, coordinates, light);
    diffracted = mat3(xyz_to_working) * xyz;
}

#include "engine/render/shaders/forward_vertex_main.glsl"

#version 450 core
// A metallic-roughness surface under a thin film: PHYSICS (4.2), (5.1).
#define MATERIAL_SPECULAR
#define MATERIAL_SPECULAR_LOBE
#define MATERIAL_TRANSMITTANCE
#ifdef FILM_PASSES_LIGHT
#define MATERIAL_PASSES_LIGHT
#endif
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"
#include "modules/thin_film/shaders/film_lookup.glsl"

#ifdef FILM_FACTOR_MAP
TEXTURE_UNIT(9) uniform sampler2D film_factor_map;  // R
#endif
#ifdef FILM_THICKNESS_MAP
TEXTURE_UNIT(10) uniform sampler2D film_thickness_map;  // G
#endif
uniform float film_factor;
uniform vec2 film_thickness;  // nm: where the thickness map is 0, and where it is 1
uniform vec4 film_uv_linear[2];  // of the factor map and of the thickness map
uniform vec4 film_uv_offset;    // xy, zw: likewise

float factor;  // of this pixel
float thickness;
mat3x4 seen;   // M of the lobe that the view sees
vec3 passing;  // fraction of white light that the film transmits

vec2 film_uv(int map, vec2 uv) {
    return film_uv_linear[map].xy * uv.x + film_uv_linear[map].zw * uv.y + (map == 0 ? film_uv_offset.xy : film_uv_offset.zw);
}

void read_film() {
    factor = film_factor;
    thickness = film_thickness.y;
#ifdef FILM_FACTOR_MAP
    factor *= texture(film_factor_map, film_uv(0, FILM_FACTOR_MAP)).r;
#endif
#ifdef FILM_THICKNESS_MAP
    thickness = mix(film_thickness.x, film_thickness.y, texture(film_thickness_map, film_uv(1, FILM_THICKNESS_MAP)).g);
#endif
}

vec3 transmittance(float n_v, float roughness) {
    seen = film_lobe(n_v, thickness, roughness);
#ifdef FILM_ON_BLACK
    passing = vec3(0.0);  // the base absorbs it
#else
    passing = clamp(1.0 - factor * vec3(seen[0].w, seen[1].w, seen[2].w), 0.0, 1.0);
#endif
    return passing;
}

#ifdef FILM_PASSES_LIGHT
vec3 background_weight() { return (1.0 - surface_colour().a) * passing; }
#endif

// The reflection with a film on the fraction `factor` of the surface.
vec3 with_factor(vec3 bare, vec3 film) {
#ifdef FILM_WHOLE
    return max(film, 0.0);
#else
    return mix(bare, max(film, 0.0), factor);
#endif
}

vec3 reflect_lobe(vec3 light, vec3 f0, float n_v, float roughness, vec2 dfg) {
    vec3 bare = (f0 * dfg.x + dfg.y) * light;
    return with_factor(bare, (seen * light).rgb * (dfg.x + dfg.y));
}

vec3 reflect_specular(vec3 light, vec3 f0, float cosine) {
    vec3 bare = light * schlick_reflectance(f0, cosine);
    return with_factor(bare, (film_matrix(cosine, thickness, 0.0) * light).rgb);
}

#include "engine/render/shaders/shading.glsl"

void main() {
    read_screen_visibility();
    read_film();
    write_surface(MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0)));
}

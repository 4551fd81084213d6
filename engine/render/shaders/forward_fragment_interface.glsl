// What a material's fragment stage sees before it defines
//   MaterialTerms material_terms();
// and, if it defines MATERIAL_SPECULAR before this file,
//   vec3 reflect_specular(vec3 light, vec3 f0, float cosine);
// the light that the base's microfacets reflect of `light` (radiance or irradiance, working space) that meets them at the
// angle of this cosine. `f0`: the base's reflectance at normal incidence. Without it: light * schlick_reflectance().
// If it also defines MATERIAL_SPECULAR_LOBE, it defines
//   vec3 reflect_lobe(vec3 light, vec3 f0, float n_v, float roughness, vec2 split);
// what the whole lobe of a view reflects of the environment's light, for a reflectance whose mean over the lobe is not
// that at one angle. `split`: the lobe's albedo for reflectance 1 - (1 - cosine)^5 and for (1 - cosine)^5.
// If it defines MATERIAL_TRANSMITTANCE, it also defines
//   vec3 transmittance(float n_v, float roughness);
// the fraction of the light that passes on to the diffuse base and, where the surface blends, of what lies behind it.
// Called before reflect_lobe().
// If it defines MATERIAL_PASSES_LIGHT, which needs StandardMaterial::passes_light, it also defines
//   vec3 background_weight();
// the fraction of what lies behind that is seen through the surface. Called after material_terms().
// If it defines MATERIAL_DIRECTIONAL_LIGHTS, MATERIAL_PUNCTUAL_LIGHTS or both, it also defines
//   void material_light(int i, float attenuation, vec3 l, inout vec3 added);
// which adds to its own radiance that of lights[i], of that kind. `attenuation`: irradiance on a surface that faces the
// light, over its strength; `l`: toward it. Called after material_terms().
// If it defines MATERIAL_GLOSS, it also defines
//   float gloss_reflectance(float cosine);
//   float gloss_roughness();
// of a layer on top, in which the scene's lights have highlights: reflectance at the angle of this cosine, perceptual
// roughness.
// If it defines MATERIAL_CURVED_MIRROR, what its mirror shows is averaged over the pixel.
#include "engine/render/shaders/frame_block.h"
#include "engine/render/shaders/object_block.h"
#include "engine/render/shaders/ambient_light.glsl"
#include "engine/render/shaders/screen_visibility.glsl"

in vec3 world_position;
in vec3 world_normal;

#ifdef NORMAL_MAP
in vec4 world_tangent;
#endif
#ifdef HAS_UV
in vec2 uv;
#endif
#ifdef HAS_UV1
in vec2 uv1;
#endif
#ifdef HAS_COLOURS
in vec4 colour;
#endif
#ifdef AMBIENT_AT_VERTICES
in vec3 ambient_at_vertex;
#endif

// What a material adds to, and leaves of, the engine's metallic-roughness surface. Working space.
struct MaterialTerms {
    vec3 base_weight;    // fraction of the light that reaches the metallic-roughness base
    vec3 mirror_weight;  // fraction that is reflected as by a mirror; read only if the
                         // material defines MATERIAL_HAS_MIRROR
    vec3 added;          // the material's own radiance
};

// A normal that does not turn away from the view: an outline's pixel may lie outside its triangle.
vec3 seen_normal(vec3 n, vec3 v) { return n - min(dot(n, v), 0.0) * v; }

// Fresnel reflectance [Schlick 1994].
vec3 schlick_reflectance(vec3 f0, float cosine) {
    float rise = 1.0 - cosine;
    float rise2 = rise * rise;
    float rise5 = rise2 * rise2 * rise;
    return f0 * (1.0 - rise5) + rise5;
}

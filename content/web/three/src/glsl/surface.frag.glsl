// Inserted after three's <lights_physical_pars_fragment> and #define SHOWN_LAYERS: the diffraction term for MeshPhysicalMaterial.
#define SEPARATE_LIGHTS
#define KEY_LOBES
#include "engine/gpu/shaders/dialect.glsl"
uniform mat3 probe_from_world;
// Set from three's varyings, as WebGL 2 promises only 60 components. Positions count from the eye.
vec3 world_position;
vec3 world_normal;
#ifdef ROWLAND_GROOVE_UV
in vec2 groove_uv;
#define GROOVE_MAP groove_uv
#endif
const vec3 eye = vec3(0.0);
uniform mat3 xyz_to_working;  // linear Rec.709
uniform vec3 mirror_weight;
uniform vec3 base_weight;
uniform float light_scale;  // of the probe
#include "modules/diffraction/shaders/grooves.glsl"
#include "modules/diffraction/shaders/kernel.glsl"
#include "modules/diffraction/shaders/light_blocks.h"
#include "modules/diffraction/shaders/key_light_windows.glsl"
#ifdef ROWLAND_PLANAR
#include "modules/diffraction/representations/planar/planar_map.glsl"
#endif
#ifdef ROWLAND_ARC
#include "modules/diffraction/representations/arc/arc.glsl"
#endif

GrooveView lit_view;
vec3 lit_sum;  // diffracted radiance of three's lights
#ifdef GROOVE_MAP
int lit_parts;  // parts of a pixel whose grooves vary
#endif

// In the probe, of a direction in the view.
vec3 in_probe(vec3 direction) { return probe_from_world * (vec4(direction, 0.0) * viewMatrix).xyz; }

// In the view: toward the eye, and the normal of the side that has the grooves.
void prepare_grooves(vec3 to_eye, vec3 normal) {
    world_position = -in_probe(to_eye);
    world_normal = in_probe(normal);
    lit_view = groove_view();
    lit_sum = vec3(0.0);
#ifdef GROOVE_MAP
    lit_parts = groove_parts(lit_view);
#endif
}

#ifdef GROOVE_MAP
GrooveView lit_part(int part) {
    GrooveView view = groove_part(lit_view, lit_parts, part);
    if (view.pitch <= 0.0) view.direction.z = 0.0;  // no grating: as if seen from below
    return view;
}

float coverage_of(GrooveView view) { return view.coverage / float(lit_parts); }
#endif

vec3 lamp_radiance(GrooveView view, PixelU u, vec3 s, vec3 irradiance) {
    if (view.direction.z <= 0.0) return vec3(0.0);
    float above = max(dot(s, view.axes[2]), 0.0);
    vec3 factor = 0.5 * above * cover_transmittance(above) *
                  groove_factor(dot(s, view.axes[1]) + view.direction.y);
    return kernel_to_working(factor * pitch_kernel_value(u.mean, view.direction.x, deviation_of(u), irradiance, view.pitch));
}

// Adds one of three's lights. `s`: toward it, in the probe; `irradiance`: on a surface that faces it.
void add_lamp(vec3 s, vec3 irradiance) {
#ifdef GROOVE_MAP
    MeshU mesh = mesh_u_of(lit_view, s);
    for (int part = 0; part < lit_parts; ++part) {
        GrooveView view = lit_part(part);
        lit_sum += coverage_of(view) * lamp_radiance(view, turned_pixel_u(view, mesh), s, irradiance);
    }
#else
    lit_sum += lamp_radiance(lit_view, pixel_u_of(lit_view, s), s, irradiance);
#endif
}

vec3 probe_radiance(GrooveView view) {
    if (view.direction.z <= 0.0) return vec3(0.0);
    vec3 sum = vec3(0.0);
#if defined(ROWLAND_PLANAR) && defined(LOBE_MAP)
    sum += map_radiance(view.direction.xy, view.axes[0]);
#elif defined(ROWLAND_PLANAR) && defined(PITCH_AXIS)
    sum += map_radiance_of_pitch(view.direction.x, view.axes[0], view.pitch);
#elif defined(ROWLAND_PLANAR)
    sum += map_radiance(view.direction.x, view.axes[0], view.axes[2]);
#endif
#ifdef ROWLAND_ARC
    sum += arc_radiance(view);
#endif
    sum += key_lights_at_pixel(view);
    return light_scale * sum;
}

// `base`: what the layer under the grooves reflects; `mirrored`: the environment in the mirror direction.
vec3 grating_surface(vec3 base, vec3 mirrored) {
    vec3 diffracted = lit_sum;
#ifdef GROOVE_MAP
    for (int part = 0; part < lit_parts; ++part) {
        GrooveView view = lit_part(part);
        diffracted += coverage_of(view) * probe_radiance(view);
    }
#else
    diffracted += probe_radiance(lit_view);
#endif
    float passed = cover_transmittance(abs(lit_view.direction.z));
#ifdef ROWLAND_DIFFRACTION_ONLY
    return passed * diffracted;
#endif
#ifdef GROOVE_MAP
    float coverage = lit_view.coverage;  // the layer has the rest of the pixel for itself
#else
    float coverage = 1.0;
#endif
    vec3 mirror = coverage * mirror_weight;
#ifdef COVER
    mirror = vec3(1.0 - passed) + passed * passed * mirror;
#endif
    return passed * (mix(vec3(1.0), base_weight, coverage) * base + diffracted) + mirror * mirrored;
}

#ifdef RE_Direct  // three's
void RE_Direct_Grating(const in IncidentLight directLight, const in vec3 geometryPosition,
                       const in vec3 geometryNormal, const in vec3 geometryViewDir,
                       const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material,
                       inout ReflectedLight reflectedLight) {
    RE_Direct_Physical(directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material,
                       reflectedLight);
    add_lamp(in_probe(directLight.direction), directLight.color);
}
#undef RE_Direct
#define RE_Direct RE_Direct_Grating
#endif

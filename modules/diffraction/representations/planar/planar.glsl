// A flat object's map in XYZ, at the pixels or at the vertices.
#include "modules/diffraction/representations/planar/planar_map.glsl"

#ifdef VERTEX_STAGE
vec3 diffracted_radiance(vec3 view, vec3 g, vec3 n) {
    if (view.z <= 0.0) return vec3(0.0);
#ifdef LOBE_MAP
    vec3 xyz = map_radiance(view.xy, g);
#else
    vec3 xyz = map_radiance(view.x, g, n);
#endif
    return mat3(xyz_to_working) * xyz;
}
#else
vec3 diffracted_radiance(GrooveView view) {
#ifdef LOBE_MAP
    vec3 xyz = map_radiance(view.direction.xy, view.axes[0]);
#elif defined(PITCH_AXIS)
    vec3 xyz = map_radiance_of_pitch(view.direction.x, view.axes[0], view.pitch);
#else
    vec3 xyz = map_radiance(view.direction.x, view.axes[0], view.axes[2]);
#endif
    return mat3(xyz_to_working) * xyz;
}
#endif

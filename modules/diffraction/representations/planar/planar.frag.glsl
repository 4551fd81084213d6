#version 450 core
// A flat object's map, at the pixels.
#include "modules/diffraction/shaders/surface.glsl"
#include "modules/diffraction/representations/planar/planar_map.glsl"

#ifdef LOBE_MAP
vec3 diffracted_radiance(GrooveView view) { return map_radiance(view.direction.xy, view.axes[0]); }
#elif defined(PITCH_AXIS)
vec3 diffracted_radiance(GrooveView view) { return map_radiance_of_pitch(view.direction.x, view.axes[0], view.pitch); }
#else
vec3 diffracted_radiance(GrooveView view) { return map_radiance(view.direction.x, view.axes[0], view.axes[2]); }
#endif

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

#version 450 core
// A map for all orientations, at the pixels.
#include "modules/diffraction/shaders/surface.glsl"
#include "modules/diffraction/representations/circle/circle_map.glsl"

vec3 diffracted_radiance(GrooveView view) { return map_radiance(view.direction.x, view.axes[0], view.axes[2]); }

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

#version 450 core
// A sum over the ranks of the products from the vertices: arc_table.h.
#include "modules/diffraction/shaders/surface.glsl"
#include "modules/diffraction/representations/arc/arc_sum.glsl"

vec3 diffracted_radiance(GrooveView view) { return arc_radiance(view); }

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

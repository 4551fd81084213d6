#version 450 core
// Analytic lights and key lights alone.
#include "modules/diffraction/shaders/surface.glsl"

vec3 diffracted_radiance(GrooveView view) { return vec3(0.0); }

#include "modules/diffraction/shaders/pixel_shaded.glsl"
#include "engine/render/shaders/forward_fragment_main.glsl"

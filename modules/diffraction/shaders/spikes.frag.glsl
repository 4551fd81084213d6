#version 450 core
#define MATERIAL_HAS_MIRROR
#include "engine/render/shaders/forward_fragment_interface.glsl"

in vec3 diffracted;

// What the grating leaves to the engine, working space.
uniform vec3 mirror_weight;
uniform vec3 base_weight;

MaterialTerms material_terms() { return MaterialTerms(base_weight, mirror_weight, diffracted); }

#include "engine/render/shaders/forward_fragment_main.glsl"

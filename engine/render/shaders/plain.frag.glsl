#version 450 core
#include "engine/render/shaders/forward_fragment_interface.glsl"

MaterialTerms material_terms() { return MaterialTerms(vec3(1.0), vec3(0.0), vec3(0.0)); }

#include "engine/render/shaders/forward_fragment_main.glsl"

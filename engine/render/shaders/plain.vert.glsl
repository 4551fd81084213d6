#version 450 core
#include "engine/render/shaders/vertex.glsl"

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n) {}

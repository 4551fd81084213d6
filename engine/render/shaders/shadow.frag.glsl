#version 450 core
#include "engine/render/shaders/surface.glsl"

void main() {
#ifdef ALPHA_MASK
    if (surface_colour().a < metallic_roughness.z) discard;
#endif
}

#version 450 core
#include "engine/render/shaders/forward_fragment_interface.glsl"
#include "engine/render/shaders/surface_maps.glsl"

void main() {
#ifdef ALPHA_MASK
    if (surface_colour().a < metallic_roughness.z) discard;
#endif
}

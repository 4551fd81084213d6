#version 450 core
// A peer as a material: each light is shaded by itself. The program defines PEER, the peer's file.
#include "engine/render/shaders/surface.glsl"
#include "engine/render/shaders/environment.glsl"
#include "modules/diffraction/shaders/grooves.glsl"
#include "engine/render/shaders/shading.glsl"
#include "tests/evidence/peers/lights.glsl"
#include PEER

void main() {
    read_screen_visibility();
    GrooveView view = groove_view();
    vec3 sum = vec3(0.0);
    if (view.direction.z > 0.0)
        for (int i = 0; i < peer_lights.length(); ++i) {
            vec3 s = peer_lights[i].direction.xyz * view.axes;
            if (s.z > 0.0) sum += peer_lights[i].irradiance.rgb * peer_reflection(s, view.direction);
        }
    write_surface(MaterialTerms(vec3(1.0), vec3(0.0), mat3(rec709_to_working) * sum));
}

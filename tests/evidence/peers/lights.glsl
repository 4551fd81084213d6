// What a peer reads, and its lights. A peer's file defines vec3 peer_reflection(vec3 s, vec3 v): its BRDF times the
// light's cosine, linear Rec.709, from unit directions toward the light and the eye in the tangent frame: x across the
// grooves, y along them, z the normal.
uniform vec4 peer_parameters;  // as the peer's file says
uniform float peer_highlight;  // 1: with order 0, mirror and diffuse terms; 0: without

struct PeerLight {
    vec4 direction;   // xyz: unit, world, toward the light
    vec4 irradiance;  // xyz: on a surface that faces it, linear Rec.709
};
layout(std430, binding = 4) readonly buffer PeerLights { PeerLight peer_lights[]; };

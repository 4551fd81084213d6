#version 450 core

layout(location = 0) out vec4 exposed;

layout(binding = 0) uniform sampler2D scene_linear;
uniform float scale;

void main() {
    vec4 colour = texelFetch(scene_linear, ivec2(gl_FragCoord.xy), 0);
    exposed = vec4(scale * colour.rgb, colour.a);
}

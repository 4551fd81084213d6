#version 450 core
// Colour, and the radius in pixels of the disc that the lens makes of a point of the pixel's surface; negative nearer
// than the focus.
layout(location = 0) out vec4 disc;

layout(binding = 0) uniform sampler2D scene_linear;
layout(binding = 1) uniform sampler2D scene_depth;
uniform vec2 planes;  // near and far, metres
uniform vec3 blur;    // radius at infinity, pixels; distance in focus, metres; largest radius

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float depth = 2.0 * texelFetch(scene_depth, pixel, 0).x - 1.0;
    float distance = 2.0 * planes.x * planes.y / (planes.x + planes.y - depth * (planes.y - planes.x));
    float radius = clamp(blur.x * (1.0 - blur.y / distance), -blur.z, blur.z);
    disc = vec4(texelFetch(scene_linear, pixel, 0).rgb, radius);
}

#version 450 core
#include "engine/render/shaders/scene_blocks.h"

layout(binding = 0) uniform samplerCube environment_map;

in vec3 direction;
layout(location = 0) out vec4 radiance;

// The direction in which the probe's camera captured what the eye sees: a point of a sphere about that camera, or of
// the floor below it.
vec3 from_capture(vec3 seen) {
    vec3 from = eye.xyz - vec3(0.0, dome.x, 0.0);
    float along = dot(from, seen);
    float distance = sqrt(max(along * along - dot(from, from) + dome.y * dome.y, 0.0)) - along;
    if (seen.y < 0.0) distance = min(distance, max(-eye.y / seen.y, 0.0));
    return from + distance * seen;
}

// The light between texels much larger than pixels: a quadratic spline, as the mean of four linear look-ups, since lamps
// and sunlit patches would end in steps.
vec3 smooth_light(vec3 s) {
    float size = float(textureSize(environment_map, 0).x);
    vec3 on_cube = s / max(abs(s.x), max(abs(s.y), abs(s.z)));
    vec3 part = fract((0.5 * on_cube + 0.5) * size);
    vec3 away = (part * (part - 1.0) + 0.5) * (2.0 / size) * vec3(lessThan(abs(on_cube), vec3(1.0)));
    vec3 light = textureLod(environment_map, on_cube + away, 0.0).rgb;
    light += textureLod(environment_map, on_cube + away * vec3(1.0, -1.0, -1.0), 0.0).rgb;
    light += textureLod(environment_map, on_cube + away * vec3(-1.0, 1.0, -1.0), 0.0).rgb;
    light += textureLod(environment_map, on_cube + away * vec3(-1.0, -1.0, 1.0), 0.0).rgb;
    return 0.25 * light;
}

void main() {
    vec3 light = dome.y > 0.0 ? smooth_light(from_capture(normalize(direction)))
                              : textureLod(environment_map, direction, 0.0).rgb;
    radiance = vec4(light * environment.y, 1.0);
    if (shadow.z > 0.0) radiance = rounded_to_half(radiance);
}

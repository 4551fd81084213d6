#version 450 core

#include "glare_grid.glsl"

layout(location = 0) out vec4 light;

vec2 tangents_of(vec2 cosines) {
    return cosines * inversesqrt(max(1.0 - dot(cosines, cosines), 1e-4));
}

// The range of pixels that may lie between two corners, given in direction cosines. The tangents are monotonic in both
// cosines on either side of the axes.
void pixels_between(vec2 low, vec2 high, out ivec2 first, out ivec2 last) {
    vec2 nearest = clamp(vec2(0.0), low, high);
    vec2 farthest = mix(low, high, greaterThan(abs(high), abs(low)));
    vec2 least = min(vec2(tangents_of(vec2(low.x, nearest.y)).x, tangents_of(vec2(nearest.x, low.y)).y),
                     vec2(tangents_of(vec2(low.x, farthest.y)).x, tangents_of(vec2(farthest.x, low.y)).y));
    vec2 most = max(vec2(tangents_of(vec2(high.x, nearest.y)).x, tangents_of(vec2(nearest.x, high.y)).y),
                    vec2(tangents_of(vec2(high.x, farthest.y)).x, tangents_of(vec2(farthest.x, high.y)).y));
    vec2 size = vec2(textureSize(scene_linear, 0));
    first = ivec2(clamp(floor(size * (0.5 + 0.5 * least / tan_half_fov) - 0.5), vec2(0.0), size - 1.0));
    last = ivec2(clamp(ceil(size * (0.5 + 0.5 * most / tan_half_fov) - 0.5), vec2(0.0), size - 1.0));
}

// Sums the bright light of the pixels around a cell, weighted by the cell's spline and by the pixel's area (cos⁴) over
// the cell's, both in direction cosines.
void main() {
    vec2 centre = floor(gl_FragCoord.xy);
    vec2 cosines = (centre - 0.5 * vec2(cells - 1)) * cell;
    ivec2 first;
    ivec2 last;
    pixels_between(cosines - 1.5 * cell, cosines + 1.5 * cell, first, last);
    vec3 sum = vec3(0.0);
    for (int y = first.y; y <= last.y; ++y) {
        for (int x = first.x; x <= last.x; ++x) {
            vec2 at = tangents(ivec2(x, y));
            float cos_squared = 1.0 / (1.0 + dot(at, at));
            sum += spline(position_in_cells(at) - centre) * cos_squared * cos_squared *
                   bright(usable(texelFetch(scene_linear, ivec2(x, y), 0).rgb));
        }
    }
    vec2 pixel = 2.0 * tan_half_fov / vec2(textureSize(scene_linear, 0));
    light = vec4(pixel.x * pixel.y / (cell * cell) * sum, 1.0);
}

#version 450 core
// Short strokes along the grooves, one per cell of a grid on the picture; elsewhere transparent. Straight alpha.

in vec3 world_position;
in vec3 world_normal;
in vec4 world_tangent;
in vec2 uv;

uniform bool chosen;  // whether the surface's grooves are shown; if not, it only hides others
uniform mat4 world_to_clip;
uniform vec2 size;         // of the picture, pixels
uniform float cell;        // pixels
uniform float step_length;  // along the surface, for the direction in the picture
uniform float groove_rotation;
uniform bool mapped;
layout(binding = 13) uniform sampler2D groove_map;  // moments for even kernels (groove_map.h)
uniform vec4 groove_uv_linear;
uniform vec2 groove_uv_offset;

layout(location = 0) out vec4 colour;

vec2 pixel_of(vec3 position) {
    vec4 clip = world_to_clip * vec4(position, 1.0);
    return (0.5 + 0.5 * clip.xy / clip.w) * size;
}

void main() {
    colour = vec4(0.0);
    if (!chosen) return;
    float rotation = groove_rotation;
    if (mapped) {
        vec4 moments = texture(groove_map, groove_uv_linear.xy * uv.x + groove_uv_linear.zw * uv.y + groove_uv_offset);
        if (moments.z == 0.0) return;  // no grating here
        rotation += 0.5 * atan(2.0 * moments.y - 1.0, 2.0 * moments.x - 1.0);
    }
    vec3 n = normalize(world_normal);
    vec3 t = normalize(world_tangent.xyz - n * dot(n, world_tangent.xyz));
    vec3 b = world_tangent.w * cross(n, t);
    vec3 along = cos(rotation) * b - sin(rotation) * t;  // perpendicular to the grating vector cos t + sin b
    vec2 direction = normalize(pixel_of(world_position + step_length * along) - pixel_of(world_position));

    float row = floor(gl_FragCoord.y / cell);
    float shift = mod(row, 2.0) * 0.5 * cell;
    vec2 middle = vec2((floor((gl_FragCoord.x - shift) / cell) + 0.5) * cell + shift, (row + 0.5) * cell);
    vec2 from_middle = gl_FragCoord.xy - middle;
    float across = abs(direction.x * from_middle.y - direction.y * from_middle.x);
    float beyond = abs(dot(direction, from_middle)) - 0.36 * cell;
    float distance = max(across, beyond);
    float white = 1.0 - smoothstep(0.6, 1.3, distance);
    float dark = 1.0 - smoothstep(1.6, 2.6, distance);
    colour = vec4(vec3(white), 0.85 * max(white, 0.6 * dark));
}

#version 450 core
// The mesh's tangent frame for groove_overlay.frag.glsl.

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec4 vertex_tangent;
layout(location = 3) in vec2 vertex_uv;
layout(location = 4) in vec2 vertex_uv1;

uniform mat4 object_to_world;
uniform mat3 normal_to_world;
uniform mat4 world_to_clip;
uniform float mirroring;  // sign of the determinant of object_to_world
uniform int uv_set;

out vec3 world_position;
out vec3 world_normal;
out vec4 world_tangent;  // w: sign of the bitangent
out vec2 uv;

void main() {
    vec4 world = object_to_world * vec4(vertex_position, 1.0);
    world_position = world.xyz;
    world_normal = normal_to_world * vertex_normal;
    world_tangent = vec4(mat3(object_to_world) * vertex_tangent.xyz, vertex_tangent.w * mirroring);
    uv = uv_set == 1 ? vertex_uv1 : vertex_uv;
    gl_Position = world_to_clip * world;
}

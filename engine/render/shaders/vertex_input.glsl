// What every vertex stage reads, and what it passes to surface.glsl.
#include "engine/render/shaders/scene_blocks.h"

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec4 vertex_tangent;

out vec3 world_position;
out vec3 world_normal;

#ifdef NORMAL_MAP
out vec4 world_tangent;  // w: sign of the bitangent
#endif
#ifdef HAS_UV
layout(location = 3) in vec2 vertex_uv;
out vec2 uv;
#endif
#ifdef HAS_UV1
layout(location = 4) in vec2 vertex_uv1;
out vec2 uv1;
#endif
#ifdef HAS_COLOURS
layout(location = 5) in vec4 vertex_colour;
out vec4 colour;
#endif
#ifdef INSTANCED
layout(location = 8) in mat4x3 instance_to_world;
layout(location = 12) in mat3 instance_normal_to_world;

mat4 to_world() { return mat4(instance_to_world); }
mat3 normals_to_world() { return instance_normal_to_world; }
#else
mat4 to_world() { return object_to_world; }
mat3 normals_to_world() { return mat3(normal_to_world); }
#endif
#ifdef AMBIENT_AT_VERTICES
out vec3 ambient_at_vertex;
#endif
#ifdef SKINNED
layout(location = 6) in uvec4 vertex_joints;
layout(location = 7) in vec4 vertex_weights;
layout(std430, binding = 3) readonly buffer Joints { mat4 joints[]; };

mat4 joint(uint i) { return joints[uint(map_strength.w) + i]; }
mat4 pose() {
    return vertex_weights.x * joint(vertex_joints.x) + vertex_weights.y * joint(vertex_joints.y) +
           vertex_weights.z * joint(vertex_joints.z) + vertex_weights.w * joint(vertex_joints.w);
}
#else
mat4 pose() { return mat4(1.0); }
#endif

// Passes the attributes of the fragment stage through.
void pass_attributes() {
#ifdef HAS_UV
    uv = vertex_uv;
#endif
#ifdef HAS_UV1
    uv1 = vertex_uv1;
#endif
#ifdef HAS_COLOURS
    colour = vertex_colour;
#endif
}

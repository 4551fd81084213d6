// The vertex stage of every surface. The file that includes it defines below
//   void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n);
// world space; (g, h, n) is the right-handed tangent frame, g along the mesh's tangent. A material that reads texture
// coordinates defines HAS_UV or HAS_UV1 with its program.
#include "engine/render/shaders/vertex_input.glsl"

void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n);

void main() {
    vec3 position = vertex_position;
    vec3 normal = vertex_normal;
    vec3 tangent = vertex_tangent.xyz;
    float determinant_sign = map_strength.z;
#ifdef SKINNED
    mat4 skin = pose();
    mat3 linear = mat3(skin);
    mat3 cofactors = mat3(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
    float skin_determinant_sign = dot(cofactors[0], linear[0]) < 0.0 ? -1.0 : 1.0;
    position = (skin * vec4(position, 1.0)).xyz;
    normal = skin_determinant_sign * (cofactors * normal);
    tangent = linear * tangent;
    determinant_sign *= skin_determinant_sign;
#endif
    vec4 world = to_world() * vec4(position, 1.0);
    vec3 n = normalize(normals_to_world() * normal);
    vec3 g = mat3(to_world()) * tangent;
    g = normalize(g - n * dot(n, g));
    world_position = world.xyz;
    world_normal = n;
#ifdef NORMAL_MAP
    // A mirroring transform flips the cross product.
    world_tangent = vec4(g, vertex_tangent.w * determinant_sign);
#endif
#ifdef AMBIENT_AT_VERTICES
    ambient_at_vertex = ambient_light(n);
#endif
    pass_attributes();
    material_vertex(world.xyz, g, cross(n, g), n);
    gl_Position = view_projection * world;
}

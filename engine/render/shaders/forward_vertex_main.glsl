void main() {
    vec4 world = object_to_world * vec4(vertex_position, 1.0);
    vec3 n = normalize(mat3(normal_to_world) * vertex_normal);
    vec3 g = mat3(object_to_world) * vertex_tangent;
    g = normalize(g - n * dot(n, g));
    world_position = world.xyz;
    world_normal = n;
    material_vertex(world.xyz, g, cross(n, g), n);
    gl_Position = view_projection * world;
}

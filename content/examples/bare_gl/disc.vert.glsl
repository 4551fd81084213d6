// A ring of 250 segments as a triangle strip, made from nothing but the vertex's number.
uniform mat4 world_to_clip;
uniform mat4 disc_to_world;
out vec3 world_position;

void main() {
    float angle = 6.28318530717959 / 250.0 * float(gl_VertexID / 2);
    float radius = gl_VertexID % 2 == 0 ? 0.023 : 0.058;
    vec4 world = disc_to_world * vec4(radius * cos(angle), 0.0, radius * sin(angle), 1.0);
    world_position = world.xyz;
    gl_Position = world_to_clip * world;
}

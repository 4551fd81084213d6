// A flat object's map over the azimuth of g in its plane and v_g: planar_map.h.
layout(binding = 11) uniform sampler2D planar_map;
uniform vec3 planar_e1;  // the azimuth's axes in the world
uniform vec3 planar_e2;
uniform float map_scale;  // of the stored values

vec3 map_xyz(float v_g, vec3 g, vec3 n) {
    vec2 nodes = vec2(textureSize(planar_map, 0));
    float azimuth = atan(dot(g, planar_e2), dot(g, planar_e1));
    vec2 uv = vec2(azimuth / 6.28318530717959 + 0.5 / nodes.x,
                      ((0.5 * v_g + 0.5) * (nodes.y - 1.0) + 0.5) / nodes.y);
    return map_scale * textureLod(planar_map, uv, 0.0).xyz;
}

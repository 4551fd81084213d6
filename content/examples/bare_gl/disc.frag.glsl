// The program puts Rowland's dialect.glsl, planar_map.glsl and kernel.glsl before this file.
in vec3 world_position;
uniform vec3 eye;
uniform vec3 centre;          // of the disc
uniform vec3 normal;          // of the disc, toward the side with the grooves
uniform vec3 lamp_direction;  // unit, toward the lamp
uniform vec3 lamp_flux;       // RGB radiance times solid angle
uniform float lamp_radius;    // angular, in radians
uniform float exposure;

layout(location = 0) out vec4 picture;
layout(location = 1) out vec4 probe_xyz;    // these three let a test check the numbers
layout(location = 2) out vec4 lamp_xyz;
layout(location = 3) out vec4 world_point;

const mat3 XYZ_TO_REC709 = mat3(3.2409699, -0.9692436, 0.0556301, -1.5373832, 1.8759675, -0.2039770, -0.4986108,
                                0.0415551, 1.0569715);

// XYZ radiance toward the eye from a small lamp: ½ s_n d k(d u) F, PHYSICS (4.2).
vec3 lamp_radiance(vec3 v, vec3 g, vec3 n, float footprint) {
    float s_g = dot(lamp_direction, g);
    float of_lamp = 0.5 * lamp_radius * sqrt(1.0 - s_g * s_g);     // standard deviation of s_g over the lamp
    float deviation = length(vec2(of_lamp, 0.57735 * footprint));  // with the pixel's
    return 0.5 * max(dot(lamp_direction, n), 0.0) * kernel_value(s_g + dot(v, g), dot(v, g), deviation, lamp_flux);
}

void main() {
    vec3 n = normal;
    vec3 g = normalize(world_position - centre);  // across the grooves, in the surface
    vec3 v = normalize(eye - world_position);     // toward the eye
    float footprint = 0.5 * fwidth(dot(v, g));

    vec3 probe = vec3(0.0), lamp = vec3(0.0);
    if (dot(v, n) > 0.0) {
        probe = map_radiance(dot(v, g), g, n);
        lamp = lamp_radiance(v, g, n, footprint);
    }

    vec3 rgb = XYZ_TO_REC709 * (probe + lamp);
    rgb -= min(min(rgb.r, rgb.g), min(rgb.b, 0.0));  // out of gamut: desaturated until no component is negative
    float brightest = max(max(rgb.r, rgb.g), max(rgb.b, 1e-9));  // tone mapping by one factor for all three keeps the hue
    picture = vec4(pow(rgb / brightest * (1.0 - exp(-exposure * brightest)), vec3(1.0 / 2.2)), 1.0);
    probe_xyz = vec4(probe, 1.0);
    lamp_xyz = vec4(lamp, 1.0);
    world_point = vec4(world_position, footprint);
}

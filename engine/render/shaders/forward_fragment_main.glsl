layout(binding = 0) uniform samplerCube environment_map;
layout(binding = 1) uniform sampler2D brdf_table;

layout(location = 0) out vec4 radiance;

const float PI = 3.14159265358979;

// Irradiance / pi from the shared probe: nine terms [Ramamoorthi & Hanrahan 2001].
vec3 ambient_light(vec3 n) {
    vec3 sum = 0.282095 * ambient[0].xyz;
    sum += 0.488603 * (n.y * ambient[1].xyz + n.z * ambient[2].xyz + n.x * ambient[3].xyz);
    sum += 1.092548 * (n.x * n.y * ambient[4].xyz + n.y * n.z * ambient[5].xyz + n.x * n.z * ambient[7].xyz);
    sum += 0.315392 * (3.0 * n.z * n.z - 1.0) * ambient[6].xyz;
    sum += 0.546274 * (n.x * n.x - n.y * n.y) * ambient[8].xyz;
    return max(sum, 0.0);
}

vec3 environment_light(vec3 direction, float roughness) {
    return textureLod(environment_map, direction, roughness * environment.x).rgb * environment.y;
}

// GGX with height-correlated Smith visibility [Heitz 2014] and Schlick's Fresnel term; the directional light's share.
vec3 key_light(vec3 n, vec3 v, vec3 diffuse, vec3 f0, float roughness) {
    vec3 l = key_direction.xyz;
    vec3 h = normalize(l + v);
    float n_l = max(dot(n, l), 0.0);
    float n_v = max(dot(n, v), 1e-4);
    float n_h = clamp(dot(n, h), 0.0, 1.0);
    float alpha2 = max(roughness * roughness * roughness * roughness, 1e-6);
    float d = n_h * n_h * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (PI * d * d);
    float shadowing = n_l * sqrt(n_v * n_v * (1.0 - alpha2) + alpha2) + n_v * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2);
    vec3 fresnel = f0 + (1.0 - f0) * pow(1.0 - clamp(dot(v, h), 0.0, 1.0), 5.0);
    return (diffuse / PI + fresnel * distribution * 0.5 / max(shadowing, 1e-6)) * n_l * key_irradiance.xyz;
}

// Split sum [Karis 2013] over the prefiltered probe.
vec3 base_radiance(vec3 n, vec3 v) {
    float metallic = metallic_roughness.x;
    float roughness = metallic_roughness.y;
    vec3 f0 = mix(vec3(0.04), base_colour.xyz, metallic);
    vec3 diffuse = base_colour.xyz * (1.0 - metallic);
    vec2 split = texture(brdf_table, vec2(max(dot(n, v), 0.0), roughness)).rg;
    vec3 reflected = (f0 * split.x + split.y) * environment_light(reflect(-v, n), roughness);
    return diffuse * ambient_light(n) + reflected + key_light(n, v, diffuse, f0, roughness);
}

void main() {
    vec3 v = normalize(eye.xyz - world_position);
    vec3 n = normalize(world_normal);
    MaterialTerms terms = material_terms();
    vec3 sum = terms.added + terms.base_weight * base_radiance(n, v);
#ifdef MATERIAL_HAS_MIRROR
    sum += terms.mirror_weight * environment_light(reflect(-v, n), 0.0);
#endif
    radiance = vec4(sum, 1.0);
}

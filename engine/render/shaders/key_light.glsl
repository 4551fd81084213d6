// Irradiance from all key lights on a surface of normal n, working space: engine/render/light_maps.h.
TEXTURE_UNIT(15) uniform samplerCube key_irradiance_map;

vec3 key_irradiance(vec3 n) { return textureLod(key_irradiance_map, n, 0.0).rgb * environment.z; }

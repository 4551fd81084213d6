// Data of the frame, of an object, of the scene's lights and of the plane that mirrors show. Included by C++ and GLSL;
// std140, so vec4 and mat4 only.
#ifdef __cplusplus
#pragma once
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#define ROWLAND_BLOCK(point, name) struct name
namespace rowland::render {
using glm::mat4;
using glm::vec4;
#else
#include "engine/gpu/shaders/dialect.glsl"
#define ROWLAND_BLOCK(point, name) BLOCK_BINDING(point) uniform name
#endif
#define ROWLAND_MAXIMUM_LIGHTS 64

ROWLAND_BLOCK(0, FrameBlock) {
    mat4 view_projection;
    mat4 clip_to_world;      // inverse of the projection and the camera's rotation, without its translation
    mat4 world_to_shadow;    // clip space of the shadow map; parallel, so w stays 1
    mat4 xyz_to_working;     // upper 3x3
    mat4 rec709_to_working;  // upper 3x3
    vec4 eye;                // xyz: world position, metres
    vec4 ambient[9];         // xyz: SH of irradiance / pi, working space; without the key lights
    vec4 environment;        // x: mip levels - 1; y: radiance per stored unit; z: irradiance per unit of
                             // key_irradiance_map
    vec4 shadow;             // x: width of a shadow texel, metres; y: of the map, 1 / texels; z: 1 if the target holds
                             // half floats; w: penumbra_over_depth() in engine/render/scene_lights.h
    mat4 box_to_world;       // of the box about a local probe, between -1 and 1, with the probe in its middle
    mat4 world_to_box;       // its inverse; both read only under LOCAL_PROBE
    vec4 dome;               // x: height of the probe's camera above the floor y = 0, metres; y: radius; 0: none;
                             // zw: 1 / pixels of the picture
};

ROWLAND_BLOCK(1, ObjectBlock) {
    mat4 object_to_world;
    mat4 normal_to_world;     // inverse transpose of the upper 3x3
    vec4 base_colour;         // xyz: working space, or Rec.709 where a texture or vertex colours multiply it; w: alpha
    vec4 metallic_roughness;  // x: metallic; y: perceptual roughness; z: alpha cutoff; w: strength of the clear coat
    vec4 emissive;            // xyz: radiance, working space, or Rec.709 where a texture multiplies it; w: perceptual
                              // roughness of the clear coat
    vec4 map_strength;        // x: normal scale; y: occlusion strength; z: sign of object_to_world's determinant;
                              // w: the object's first joint matrix
    vec4 light_part;          // x: of the surface's light that this draw gives; under LIGHT_PART
    vec4 uv_linear[6];  // of each map (base colour, metallic-roughness, normal, occlusion, emissive, wear): the 2x2
                        // part of its texture transform, column after column
    vec4 uv_offset[6];  // xy
};

struct Light {
    vec4 position;  // xyz: unit direction toward a directional light, else metres; w: 1 / range^4, or 0 without a range
    vec4 strength;  // xyz: irradiance, for points and spots at 1 m; working space. w: the variance of a disc: a
                    // quarter of the squared sine of a directional light's angular radius, else of the squared radius,
                    // m^2
    // Of a spot: xyz: its direction times a scale, w: an offset. w - dot(xyz, l) is 0 at the outer cone and 1 at the
    // inner one, for l toward the light. Of a point: 0, 0, 0, 1.
    vec4 axis;
};
ROWLAND_BLOCK(2, LightBlock) {
    vec4 light_counts;  // x: directional lights, which come first; y: all
    Light lights[ROWLAND_MAXIMUM_LIGHTS];
};

ROWLAND_BLOCK(3, ReflectionBlock) {
    mat4 world_to_plane;   // x, z: along the plane from its middle; y: above it
    vec4 plane_size;       // xy: half of its sides; z: angle of a pixel, radians; w: 1 if it has a map
    vec4 plane_normal;     // xyz: unit, world; w: perceptual roughness
    vec4 plane_ambient;    // xyz: radiance if it were white, without the light that casts shadows; working space
    vec4 plane_lamp;       // xyz: radiance if it were white, of that light
    vec4 plane_colour;     // xyz: as ObjectBlock's base_colour
    vec4 plane_uv_linear;  // columns of the 2x2 part of x, z to texture coordinates
    vec4 plane_uv_offset;  // xy
};
#ifdef __cplusplus
static_assert(sizeof(FrameBlock) == 7 * 64 + 13 * 16 && sizeof(ObjectBlock) == 2 * 64 + 17 * 16 &&
                  sizeof(LightBlock) == 16 + 48 * ROWLAND_MAXIMUM_LIGHTS && sizeof(ReflectionBlock) == 64 + 7 * 16,
              "must equal the std140 layout");
}  // namespace rowland::render
#undef ROWLAND_BLOCK
#endif

#ifndef __cplusplus
#ifdef KEY_LIGHTS
TEXTURE_UNIT(15) uniform samplerCube key_irradiance_map;  // engine/render/light_maps.h
#endif

// glTF's KHR_lights_punctual: inverse square, a window at the range, a spot's cone. `inverse`: 1 / distance.
float punctual_attenuation(Light light, float distance2, float inverse, vec3 l) {
    float window = clamp(1.0 - distance2 * distance2 * light.position.w, 0.0, 1.0);
    float cone = clamp(light.axis.w - dot(light.axis.xyz, l), 0.0, 1.0) * inverse;
    return window * cone * cone;
}

// Irradiance / pi from the probe on a surface of normal n, at pixels or vertices: nine SH terms [Ramamoorthi & Hanrahan
// 2001] and, under KEY_LIGHTS, the key lights.
vec3 ambient_light(vec3 n) {
    vec3 sum = 0.282095 * ambient[0].xyz;
    sum += 0.488603 * (n.y * ambient[1].xyz + n.z * ambient[2].xyz + n.x * ambient[3].xyz);
    sum += 1.092548 * (n.x * n.y * ambient[4].xyz + n.y * n.z * ambient[5].xyz + n.x * n.z * ambient[7].xyz);
    sum += 0.315392 * (3.0 * n.z * n.z - 1.0) * ambient[6].xyz;
    sum += 0.546274 * (n.x * n.x - n.y * n.y) * ambient[8].xyz;
#ifdef KEY_LIGHTS
    sum += textureLod(key_irradiance_map, n, 0.0).rgb * environment.z * 0.31830988618379;
#endif
    return max(sum, 0.0);
}
#endif

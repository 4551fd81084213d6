// What OpenGL's GLSL and GLSL ES 3.00 (WebGL 2) write differently. Shaders include this below #version.
//   TEXTURE_UNIT(unit)          before a sampler; programs in ES set units by the samplers' names
//   BLOCK_BINDING(point)        before a uniform block, likewise
//   SAMPLER_LINE, LINE_LOD(name, x, level)  a texture of one row; in ES one of height 1
//   STORAGE(point, block, type, name)  an array of vec4 of any length; in ES a texture of rows of 1024 texels
//   STORED_VEC4(name, i)        an element of it
//   SAMPLER_BUFFER, BUFFER_TEXEL(name, i)  a buffer read as texels, and one of them; in ES such a texture
#ifdef GL_ES
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp sampler2DArray;
precision highp sampler2DShadow;
precision highp sampler3D;
precision highp samplerCube;
#define TEXTURE_UNIT(unit)
#define BLOCK_BINDING(point) layout(std140)
#define SAMPLER_LINE sampler2D
#define LINE_LOD(name, x, level) textureLod(name, vec2(x, 0.5), level)
#define STORAGE(point, block, type, name) uniform sampler2D name
#define STORED_VEC4(name, i) texelFetch(name, ivec2((i) & 1023, (i) >> 10), 0)
#define SAMPLER_BUFFER sampler2D
#define BUFFER_TEXEL(name, i) STORED_VEC4(name, i)
#else
#define TEXTURE_UNIT(unit) layout(binding = unit)
#define BLOCK_BINDING(point) layout(std140, binding = point)
#define SAMPLER_LINE sampler1D
#define LINE_LOD(name, x, level) textureLod(name, x, level)
#define STORAGE(point, block, type, name) layout(std430, binding = point) readonly buffer block { type name[]; }
#define STORED_VEC4(name, i) name[i]
#define SAMPLER_BUFFER samplerBuffer
#define BUFFER_TEXEL(name, i) texelFetch(name, i)
#endif

// Rounds to the nearest normal half float, ties to even. For values drawn into half floats: drivers may truncate, which
// loses light in every pass.
vec4 rounded_to_half(vec4 value) {
    uvec4 bits = floatBitsToUint(value);
    return uintBitsToFloat((bits + 0xfffu + ((bits >> 13) & 1u)) & 0xffffe000u);
}

// What OpenGL's GLSL and GLSL ES 3.00 (WebGL 2) write differently. A ShaderLibrary puts this below #version.
//   TEXTURE_UNIT(unit)          before a sampler. ES sets units by the samplers' names
//   BLOCK_BINDING(point)        before a uniform block, likewise
//   STORAGE(point, block, type, name)  an array of vec4 or float of any length; in ES a texture of rows of 1024 texels
//   STORED_VEC4(name, i), STORED_FLOAT(name, i)  an element of it
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
#define STORAGE(point, block, type, name) uniform sampler2D name
#define STORED_VEC4(name, i) texelFetch(name, ivec2((i) & 1023, (i) >> 10), 0)
#define STORED_FLOAT(name, i) texelFetch(name, ivec2((i) & 1023, (i) >> 10), 0).x
#else
#define TEXTURE_UNIT(unit) layout(binding = unit)
#define BLOCK_BINDING(point) layout(std140, binding = point)
#define STORAGE(point, block, type, name) layout(std430, binding = point) readonly buffer block { type name[]; }
#define STORED_VEC4(name, i) name[i]
#define STORED_FLOAT(name, i) name[i]
#endif

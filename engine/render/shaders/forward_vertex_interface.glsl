// What a material's vertex stage sees before it defines
//   void material_vertex(vec3 position, vec3 g, vec3 h, vec3 n);
// world space; (g, h, n) is the right-handed tangent frame, g along the mesh's tangent.
#include "engine/render/shaders/frame_block.h"
#include "engine/render/shaders/object_block.h"

layout(location = 0) in vec3 vertex_position;
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec3 vertex_tangent;

out vec3 world_position;
out vec3 world_normal;

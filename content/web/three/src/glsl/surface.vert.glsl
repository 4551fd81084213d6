// Inserted after three's <common>.
#include "content/web/three/src/glsl/grating.vert.glsl"

void pass_grooves_in_view(vec3 position, vec3 normal, vec4 tangent, vec3 normal_in_view) {
    pass_grooves(position, normal, tangent, modelMatrix, normalize((vec4(normal_in_view, 0.0) * viewMatrix).xyz));
}

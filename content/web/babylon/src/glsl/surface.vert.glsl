// Inserted before main() of Babylon's vertex shader.
uniform mat4 to_probe;
#include "content/web/three/src/glsl/grating.vert.glsl"

// Inserted before main() of Babylon's fragment shader.
uniform mat4 to_probe;
#define eye (mat3(to_probe) * vEyePosition.xyz)
#include "content/web/three/src/glsl/grating.frag.glsl"

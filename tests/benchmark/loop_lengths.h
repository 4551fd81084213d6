#pragma once

#include <epoxy/gl.h>

#include <map>
#include <string>

namespace rowland::benchmark {

/// How often loops run whose length the shaders read from memory, by the GLSL expression of the length.
using LoopLengths = std::map<std::string, int>;

/// Those of the current draw, as the buffers bound now say.
LoopLengths loop_lengths(GLuint program);

}  // namespace rowland::benchmark

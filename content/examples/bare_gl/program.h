#pragma once

#include <epoxy/gl.h>

#include <string>
#include <vector>

/// The text of a file. Throws std::runtime_error.
std::string read_text(const std::string& path);

/// Compiles the vertex and the fragment shader, each from its texts in order, and links them. Throws
/// std::runtime_error with the driver's log.
GLuint make_program(const std::vector<std::string>& vertex, const std::vector<std::string>& fragment);

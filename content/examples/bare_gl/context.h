#pragma once

/// Makes an OpenGL 4.5 context current that draws into framebuffer objects only. Throws std::runtime_error.
void make_headless_context();

#pragma once

#include <functional>
#include <string>

namespace rowland::app {

/// Runs `body(renderer)` in an OpenGL context without a window. `renderer` is the device's name. `debug`: the driver's
/// messages are logged. Throws Error (system) without OpenGL 4.5 core.
void render_offscreen(bool debug, const std::function<void(const std::string& renderer)>& body);

/// Throws Error (system) if no display can be reached; `remedy` says how `program` runs without one.
void require_display(const std::string& program, const std::string& remedy);

}  // namespace rowland::app

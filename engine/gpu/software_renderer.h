#pragma once

#include <string_view>

namespace rowland::gpu {

/// Whether a renderer of this name (GL_RENDERER) is a CPU rasteriser: llvmpipe and its like.
bool is_software_renderer(std::string_view renderer);

}  // namespace rowland::gpu

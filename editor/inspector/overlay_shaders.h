#pragma once

#include <span>

#include "engine/core/embedded_file.h"

namespace rowland::inspector {

/// groove_overlay.vert.glsl and groove_overlay.frag.glsl.
std::span<const EmbeddedFile> overlay_shaders();

}  // namespace rowland::inspector

#pragma once

#include <span>

#include "engine/gpu/embedded_file.h"

namespace rowland::render {

/// The renderer's shaders, and the interface files that modules' shaders include.
std::span<const gpu::EmbeddedFile> shader_files();

}  // namespace rowland::render

#pragma once

#include <span>

#include "engine/core/embedded_file.h"

namespace rowland::render {

/// The renderer's shaders, and the interface files that modules' shaders include.
std::span<const EmbeddedFile> shader_files();

}  // namespace rowland::render

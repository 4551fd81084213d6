#pragma once

#include <span>

#include "engine/gpu/embedded_file.h"

namespace rowland::diffraction {

/// The module's shaders.
std::span<const gpu::EmbeddedFile> shader_files();

}  // namespace rowland::diffraction

#pragma once

#include <span>

#include "engine/core/text.h"

namespace rowland::diffraction {

/// The module's shaders.
std::span<const EmbeddedFile> shader_files();

}  // namespace rowland::diffraction

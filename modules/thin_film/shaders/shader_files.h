#pragma once

#include <span>

#include "engine/core/text.h"

namespace rowland::thin_film {

/// The module's shaders.
std::span<const EmbeddedFile> shader_files();

}  // namespace rowland::thin_film

#pragma once

#include <span>

#include "engine/gpu/embedded_file.h"

namespace rowland::post {

/// One file: content/ocio/rowland.ocio.
std::span<const gpu::EmbeddedFile> shipped_config_file();

}  // namespace rowland::post

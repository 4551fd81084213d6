#pragma once

#include <span>

#include "engine/core/embedded_file.h"

namespace rowland::post {

/// One file: content/ocio/rowland.ocio.
std::span<const EmbeddedFile> shipped_config_file();

}  // namespace rowland::post

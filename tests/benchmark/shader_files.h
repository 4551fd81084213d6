#pragma once

#include <span>

#include "engine/gpu/embedded_file.h"

namespace rowland::benchmark {

/// The shaders of light_loop.h.
std::span<const gpu::EmbeddedFile> shader_files();

}  // namespace rowland::benchmark

#pragma once

#include <span>

#include "engine/gpu/embedded_file.h"

namespace rowland::trade {

/// The light loop's shader.
std::span<const gpu::EmbeddedFile> light_loop_files();

/// One file: the report's page, without its data.
std::span<const gpu::EmbeddedFile> report_files();

}  // namespace rowland::trade

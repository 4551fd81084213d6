#pragma once

#include <span>

#include "engine/core/embedded_file.h"

namespace rowland::trade {

std::span<const EmbeddedFile> light_loop_files();

/// One file: the report's page, without its data.
std::span<const EmbeddedFile> report_files();

}  // namespace rowland::trade

#pragma once

#include <span>

#include "engine/core/embedded_file.h"

namespace rowland::post {

/// The shaders of the post effects, for gpu::ShaderLibrary::add_embedded.
std::span<const EmbeddedFile> shader_files();

}  // namespace rowland::post

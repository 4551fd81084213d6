#pragma once

#include <optional>

#include "engine/math/sh_window.h"
#include "engine/render/renderer.h"

namespace rowland::diffraction {

/// Makes the renderer draw entities that have a SpikeSurface, with their light under `window`, or under the mildest one
/// that keeps it from ringing.
void register_module(render::Renderer& renderer, std::optional<math::SphericalWindow> window = std::nullopt);

}  // namespace rowland::diffraction

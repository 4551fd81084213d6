#pragma once

#include "engine/render/renderer.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::diffraction {

/// Makes the renderer draw entities that have a DiffractionSurface.
void register_module(render::Renderer& renderer, const DiffractionSettings& settings = {});

}  // namespace rowland::diffraction

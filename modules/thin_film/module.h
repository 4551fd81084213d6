#pragma once

#include "engine/render/renderer.h"

namespace rowland::thin_film {

/// Registers the material type that draws entities with a FilmSurface and reads glTF's KHR_materials_iridescence.
void register_module(render::Renderer& renderer);

}  // namespace rowland::thin_film

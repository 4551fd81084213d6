#pragma once

#include "engine/render/renderer.h"

namespace rowland::thin_film {

/// Makes the renderer draw entities that have a FilmSurface, and read KHR_materials_iridescence.
void register_module(render::Renderer& renderer);

}  // namespace rowland::thin_film

#include "modules/material_types.h"

#include "modules/thin_film/module.h"

namespace rowland::modules {

void register_material_types(render::Renderer& renderer, const MaterialSettings& settings) {
    diffraction::register_module(renderer, settings.diffraction);
    thin_film::register_module(renderer);
}

}  // namespace rowland::modules

#include "modules/material_types.h"

namespace rowland::modules {

void register_material_types(render::Renderer& renderer, const MaterialSettings& settings) {
    diffraction::register_module(renderer, settings.diffraction);
}

}  // namespace rowland::modules

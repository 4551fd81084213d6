#include "modules/diffraction/module.h"

#include <memory>

#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::diffraction {

void register_module(render::Renderer& renderer, const DiffractionSettings& settings) {
    renderer.add_material_type(std::make_unique<DiffractionSurfaceType>(renderer.xyz_to_working(), settings));
}

}  // namespace rowland::diffraction

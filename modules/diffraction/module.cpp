#include "modules/diffraction/module.h"

#include <memory>

#include "modules/diffraction/runtime/spike_surface.h"

namespace rowland::diffraction {

void register_module(render::Renderer& renderer, std::optional<math::SphericalWindow> window) {
    renderer.add_material_type(std::make_unique<SpikeSurfaceType>(window));
}

}  // namespace rowland::diffraction

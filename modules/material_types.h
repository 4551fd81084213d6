#pragma once

#include "engine/render/renderer.h"
#include "modules/diffraction/module.h"

namespace rowland::modules {

/// Settings of the modules that have some.
struct MaterialSettings {
    diffraction::DiffractionSettings diffraction;
};

/// Makes the renderer draw the surfaces of every module.
void register_material_types(render::Renderer& renderer, const MaterialSettings& settings = {});

}  // namespace rowland::modules

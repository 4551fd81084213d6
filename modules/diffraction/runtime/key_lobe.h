#pragma once

#include "engine/lighting/key_lights.h"
#include "modules/diffraction/shaders/key_lobe_block.h"

namespace rowland::diffraction {

/// A key light as shaders read it.
KeyLobe key_lobe(const lighting::KeyLight& light);

}  // namespace rowland::diffraction

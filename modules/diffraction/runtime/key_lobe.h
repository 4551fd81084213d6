#pragma once

#include <span>

#include "engine/lighting/key_lights.h"
#include "modules/diffraction/shaders/light_blocks.h"

namespace rowland::diffraction {

/// A key light as shaders read it.
KeyLobe key_lobe(const lighting::KeyLight& light);

/// Whether key lights are equal but for their directions.
bool same_lobes(std::span<const lighting::KeyLight> a, std::span<const lighting::KeyLight> b);

}  // namespace rowland::diffraction

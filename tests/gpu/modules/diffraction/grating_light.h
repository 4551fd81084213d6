#pragma once

#include <cstdint>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/probe_image.h"
#include "modules/diffraction/runtime/light_parts.h"

namespace rowland::diffraction {

/// A smooth probe: no radiance is below 0, nor does it change within a few texels.
lighting::ProbeImage smooth_probe();

/// Three key lights, from wide to narrow.
std::vector<lighting::KeyLight> three_keys();

/// A frame's light: a probe, and key lights on top of it.
LightParts light_of(const lighting::ProbeImage& probe, std::vector<lighting::KeyLight> keys, std::uint64_t version = 1);

}  // namespace rowland::diffraction

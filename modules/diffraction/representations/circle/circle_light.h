#pragma once

#include "engine/lighting/light_samples.h"

namespace rowland::diffraction {

/// The light of a circle map as few samples: one for each cell of .025 rad of a cube map, and one for each of its 16
/// parts where a cell's light is bright. The sums over circles then differ from those of the texels by .3 % or less
/// (PHYSICS §6). Does not depend on the number of threads.
lighting::LightSamples circle_light(const lighting::LightSamples& texels);

}  // namespace rowland::diffraction

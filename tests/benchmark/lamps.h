#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/light_probe.h"
#include "engine/scene/directional_light.h"

namespace rowland::benchmark {

/// Lamps spread evenly over the upper part of the sky. Their sum does not depend on their number.
std::vector<scene::DirectionalLight> lamps(int count);

/// A probe of a dim room with the same lamps, six degrees wide; none of them becomes a key light.
lighting::LightProbe lamp_room(int count);

}  // namespace rowland::benchmark

#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/light_probe.h"
#include "engine/scene/directional_light.h"

namespace rowland::benchmark {

/// So many lamps, spread evenly over the upper part of the sky; together as bright as one, however many there are.
std::vector<scene::DirectionalLight> lamps(int count);

/// A dim room with the same lamps, six degrees wide, in the picture that the probe is made of; none of them is a key
/// light.
lighting::LightProbe lamp_room(int count);

}  // namespace rowland::benchmark

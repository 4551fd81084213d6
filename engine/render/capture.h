#pragma once

#include <glm/vec3.hpp>

#include "engine/ecs/world.h"
#include "engine/lighting/probe_image.h"
#include "engine/render/renderer.h"

namespace rowland::render {

/// What is seen from a point in all directions, as an equirectangular image of 4 · `face_size` by 2 · `face_size`
/// texels. It is resampled from six cube faces of `face_size` texels a side, each texel the mean of four drawn pixels
/// in 32-bit floats. The working space of `renderer` must be linear Rec.709.
lighting::ProbeImage capture_surroundings(Renderer& renderer, ecs::World& world, const glm::vec3& position,
                                          int face_size);

}  // namespace rowland::render

#pragma once

#include <glm/vec3.hpp>

#include "engine/ecs/world.h"
#include "engine/lighting/probe_image.h"
#include "engine/render/renderer.h"

namespace rowland::view {

/// What is seen from a point in all directions, as an equirectangular image of 4 · `face_size` by 2 · `face_size`
/// texels: six pictures of so many texels a side, four samples to a texel, in 32-bit floats. The same on the same
/// driver, if the renderer's maps are whole (MapPace::Whole). `renderer`: one whose working space is linear Rec.709.
/// Throws Error (system) if the context is lost.
lighting::ProbeImage capture_surroundings(render::Renderer& renderer, ecs::World& world, const glm::vec3& position,
                                          int face_size);

}  // namespace rowland::view

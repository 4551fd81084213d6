#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace rowland::post {

/// The factor on scene-linear light that so many stops make: 2^stops.
float exposure_scale(float stops);

/// Multiplies scene-linear pixels by exposure_scale(stops). The twin of what the
/// display pass does.
void apply_exposure(std::span<glm::vec3> pixels, float stops);

}  // namespace rowland::post

#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/trade/inputs.h"

namespace rowland::evidence {

/// Display values of a picture whose points have these XYZ, exposed by so many stops.
std::vector<glm::vec3> panel(const trade::PictureFrames& frames, std::span<const glm::dvec3> xyz, float exposure_stops);
/// The same of numbers that a shader wrote to the screen as they are: clamped, not encoded.
std::vector<glm::vec3> raw_panel(const trade::PictureFrames& frames, std::span<const glm::dvec3> rgb);

/// Panels in rows, as a PNG in a data URL.
std::string panel_grid(const trade::PictureFrames& frames, const std::vector<std::vector<glm::vec3>>& panels,
                       int columns);

}  // namespace rowland::evidence

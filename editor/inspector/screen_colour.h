#pragma once

#include <imgui.h>

#include <glm/vec3.hpp>

namespace rowland::inspector {

// Plain sRGB for plots, which no view transform touches.

/// XYZ, mixed with white until it is in the gamut, and dimmed if it is brighter than 1.
glm::vec3 screen_colour(const glm::dvec3& xyz);
ImU32 screen_colour_u32(const glm::dvec3& xyz);

/// The colour of one wavelength, as bright as the screen allows.
ImU32 wavelength_colour(double wavelength_nm, float alpha = 1.0F);

}  // namespace rowland::inspector

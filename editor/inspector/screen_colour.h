#pragma once

#include <imgui.h>

#include <glm/vec3.hpp>

namespace rowland::inspector {

/// XYZ as a plain sRGB colour for plots, which no view transform touches: what is out of gamut is mixed with white
/// until it fits, what is brighter than 1 is dimmed.
glm::vec3 screen_colour(const glm::dvec3& xyz);

/// The same for ImGui.
ImU32 screen_colour_u32(const glm::dvec3& xyz, float alpha = 1.0F);

/// The colour of one wavelength, as bright as the screen can.
ImU32 wavelength_colour(double wavelength_nm, float alpha = 1.0F);

}  // namespace rowland::inspector

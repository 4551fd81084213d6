#pragma once

#include <glm/vec3.hpp>

namespace rowland::colour {

/// CIE 1976 (L*, a*, b*) of a colour, relative to a white. Negative components use the linear part of the scale.
glm::dvec3 xyz_to_lab(const glm::dvec3& xyz, const glm::dvec3& white);

/// CIEDE2000 colour difference of two L*a*b* colours, parametric factors 1; about 1 is just noticeable side by side
/// [Sharma, Wu & Dalal 2005, The CIEDE2000 color-difference formula].
double delta_e_2000(const glm::dvec3& lab_1, const glm::dvec3& lab_2);

}  // namespace rowland::colour

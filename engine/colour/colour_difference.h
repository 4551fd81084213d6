#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rowland::colour {

/// CIE 1976 (L*, a*, b*) of a colour, relative to a white. Negative components use the linear part of the scale.
glm::dvec3 xyz_to_lab(const glm::dvec3& xyz, const glm::dvec3& white);

/// CIEDE2000 colour difference of two L*a*b* colours, parametric factors 1; about 1 is just noticeable side by side
/// [Sharma, Wu & Dalal 2005, The CIEDE2000 color-difference formula].
double delta_e_2000(const glm::dvec3& lab_1, const glm::dvec3& lab_2);

/// Pixels per degree of visual angle on a display 3840 pixels and 0.7 m wide, seen from 0.7 m.
inline constexpr double kPixelsPerDegree = 67.02;

/// ꟻLIP: the difference of each pixel, 0 (none) to 1, that an observer sees when two pictures of one exposure
/// alternate. Source: Andersson et al. 2020, "ꟻLIP: A Difference Evaluator for Alternating Images", Proc. ACM Comput.
/// Graph. Interact. Tech. 3(2). The spans hold `width` times `height` pixels of linear Rec. 709 in [0, 1], row by row.
std::vector<double> flip(std::span<const glm::dvec3> picture, std::span<const glm::dvec3> reference, int width,
                         int height, double pixels_per_degree = kPixelsPerDegree);

/// HDR-ꟻLIP: for each pixel the largest flip() over several exposures, for pictures in XYZ of any brightness. The
/// exposures range from the one that shows the reference's largest luminance to the one that shows its median. Source:
/// Andersson et al. 2021, "Visualizing Errors in Rendered High Dynamic Range Images", Eurographics Short Papers; unlike
/// there, the median is without the black pixels of the reference, here its background. All 0 if the reference is
/// black.
std::vector<double> hdr_flip(std::span<const glm::dvec3> picture, std::span<const glm::dvec3> reference, int width,
                             int height, double pixels_per_degree = kPixelsPerDegree);

}  // namespace rowland::colour

#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rowland::trade {

/// 8-bit RGB, rows from the top.
struct RgbPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// ΔE2000 that shows as the end of the colour scale.
inline constexpr double kFullDifference = 20.0;

/// Two pictures of XYZ as the display shows them, exposed as the second asks for, and between which colours they
/// differ: ΔE2000 from black (none) over violet and green to yellow (kFullDifference or more). Side by side, each pixel
/// `magnified` times as large.
RgbPicture difference_image(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, int width, int height,
                            int magnified);

/// The colour scale at a share of kFullDifference, 0 to 1.
glm::vec3 difference_colour(double share);

}  // namespace rowland::trade

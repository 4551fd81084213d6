#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

namespace rowland::trade {

/// 8-bit RGB, rows from the top.
struct RgbPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// The picture as a PNG in a data URL.
std::string data_url(const RgbPicture& picture);

/// ΔE2000 at the end of the colour scale.
inline constexpr double kFullDifference = 20.0;

/// Two pictures of XYZ on the display, both exposed for the second, and their difference: ΔE2000 from black (none) over
/// violet and green to yellow (kFullDifference or more). Side by side, each pixel `magnified` times as large.
RgbPicture difference_image(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, int width, int height,
                            int magnified);

/// The colour scale at a fraction of kFullDifference, 0 to 1.
glm::vec3 difference_colour(double fraction);

}  // namespace rowland::trade

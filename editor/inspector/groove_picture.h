#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::inspector {

/// Patterns of foil. hexagons, tiles: each has a direction of its own; rosettes: flowers of rings; radial: the grating
/// vector points away from the middle, so that grooves are circles (rays, once they are turned by 90°).
inline constexpr std::array kFoilPatterns = {"hexagons", "tiles", "rosettes", "radial"};

/// A groove texture of a pattern, PNG. R: rotation / π; G: one half, the material's own pitch.
std::vector<std::byte> foil_pattern(std::string_view name);

/// Any PNG or JPEG as a groove texture, PNG: one whose blue is 0 everywhere is a groove texture and stays as it is;
/// another one's brightness turns the grooves, from 0 (black) to 180° (white), and there is no grating where it is
/// transparent. Throws Error (input) naming `name` if it cannot be read.
std::vector<std::byte> as_groove_picture(std::vector<std::byte> picture, const std::string& name);

}  // namespace rowland::inspector

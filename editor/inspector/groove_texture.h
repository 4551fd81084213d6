#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::inspector {

/// Patterns of foil. hexagons, tiles: one direction per cell; rosettes: flowers of rings; radial: the grating vector
/// points away from the middle, so that grooves are circles (rays after a rotation by 90°).
inline constexpr std::array kFoilPatterns = {"hexagons", "tiles", "rosettes", "radial"};

/// A groove texture as PNG; `name` is one of kFoilPatterns. R: rotation / π; G: one half, the material's own pitch.
std::vector<std::byte> foil_pattern(std::string_view name);

/// Converts a PNG or JPEG to a groove texture, PNG. A picture whose blue is 0 everywhere is one already and is returned
/// unchanged. In any other picture the brightness rotates the grooves, from 0 (black) to 180° (white), and transparent
/// texels have no grating. Throws Error (input) naming `name` if it cannot be read.
std::vector<std::byte> as_groove_texture(std::vector<std::byte> picture, const std::string& name);

}  // namespace rowland::inspector

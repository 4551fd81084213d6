#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace rowland::inspector {

/// The types of modules/diffraction/foil that need no picture, with their default numbers. radial: grooves are circles
/// (rays after a rotation by 90°). pillars: the pitch varies, for materials whose groove_lobe is flat.
inline constexpr std::array kFoilPatterns = {"pillars", "radial",      "tiles",   "hexagons",
                                             "cosmos",  "cracked_ice", "glitter", "brushed"};

/// A groove texture that repeats without a seam, but for radial and brushed, as PNG of 16 bits; `name` is one of
/// kFoilPatterns. R: rotation / π; G: half of the pitch over the material's own.
std::vector<std::byte> foil_pattern(std::string_view name);

/// Converts a PNG or JPEG to a groove texture, PNG. A picture whose blue is 0 everywhere is one already and is returned
/// unchanged. In any other picture the brightness rotates the grooves, from 0 (black) to 180° (white), and transparent
/// texels have no grating. Throws Error (input) naming `name` if it cannot be read.
std::vector<std::byte> as_groove_texture(std::vector<std::byte> picture, const std::string& name);

}  // namespace rowland::inspector

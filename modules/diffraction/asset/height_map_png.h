#pragma once

#include <string>

#include "modules/diffraction/asset/material_json.h"
#include "modules/diffraction/model/lattice.h"

namespace rowland::diffraction {

/// The largest width and height of a cell's picture.
inline constexpr int kLargestHeightMap = 256;

/// The heights of one cell from the text of a PNG, whose red is the height. The depth is not set. Throws Error (input).
HeightMap read_height_map(const NamedText& png);

/// A PNG of the same heights, as text.
std::string write_height_map(const HeightMap& map);

}  // namespace rowland::diffraction

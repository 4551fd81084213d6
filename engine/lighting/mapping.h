#pragma once

#include <string>

#include "engine/image/image.h"

namespace rowland::lighting {

/// How a probe image covers the sphere.
enum class Mapping {
    Equirectangular,  ///< top row +Y, centre −Z, right +X
    Angular,  ///< Debevec's light probe: square, centre −Z, radius = angle/π; texels beyond radius 1 are no light
    Auto,     ///< as recognised_mapping() finds; no probe has it
};

/// "equirect", "angular" or "auto". Throws Error (input) otherwise.
Mapping parse_mapping(const std::string& name);
const char* mapping_name(Mapping mapping);

/// The mapping of an image. One that is not square is equirectangular. A square one is an angular map if it is black
/// outside its inscribed circle; a tenth of that part may be bright, for captions. Throws Error (input) for another
/// square image, of more than one texel, which may be either; `file` names it.
Mapping recognised_mapping(const image::Image& image, const std::string& file);

}  // namespace rowland::lighting

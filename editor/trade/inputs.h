#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "engine/lighting/sh_light.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::trade {

/// Frames from CSV `vx,vy,vz,nx,ny,nz,gx,gy,gz` (world axes; lengths do not matter). Throws Error (input) naming the
/// row for a frame without three directions.
std::vector<diffraction::ShadingPoint> read_frames(const std::filesystem::path& path);

/// Light from CSV `l,m,r,g,b`: every (l, m) of its bands once, in any order. Throws Error (input).
lighting::ShLight read_sh_light(const std::filesystem::path& path);

/// A probe image file. `mapping`: as for parse_mapping(). Texels that were no light are counted on standard error.
lighting::ProbeImage read_probe(const std::filesystem::path& path, const std::string& mapping);

}  // namespace rowland::trade

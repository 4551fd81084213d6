#pragma once

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

/// The grating of a file that has a "lattice" in place of "pitch_nm": lattice, its profile, its orders. The caller
/// calls finish(). Throws Error (input).
Grating parse_lattice_grating(JsonReader& json, const ReadNamed& read);

}  // namespace rowland::diffraction

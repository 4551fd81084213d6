#pragma once

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

/// A groove's profile, by profile_descriptors(). Throws Error (input).
Profile parse_profile(JsonReader json, double pitch_nm, const ReadNamed& read);

}  // namespace rowland::diffraction

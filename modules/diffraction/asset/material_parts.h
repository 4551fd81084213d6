#pragma once

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

/// The members that a material file and the glTF extension have in common: grating, metal, cover, transmission, base
/// and quality. The caller asks for its own members and calls finish().
Material parse_material_parts(JsonReader& reader, const ReadNamed& read);

}  // namespace rowland::diffraction

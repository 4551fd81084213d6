#pragma once

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/asset/material_json.h"

namespace rowland::diffraction {

/// Parses a material's "quality": an error that can be borne, or a representation with its settings. A representation
/// takes the keys that mean something to it; others, and what the grating's lobe does not allow, are refused by name.
/// An illuminant's file is read by `read`.
Quality parse_quality(JsonReader json, const Grating& grating, const ReadNamed& read);

}  // namespace rowland::diffraction

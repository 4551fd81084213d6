#pragma once

#include <string>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/cooked_material.h"

namespace rowland::diffraction {

/// A material of these two JSON objects.
inline CookedMaterial cook(const std::string& grating, const std::string& quality) {
    return cook_material(parse_json("{\"grating\":" + grating + ",\"quality\":" + quality + "}", "test"), "test");
}

}  // namespace rowland::diffraction

#pragma once

#include <string>

#include "engine/core/json_reader.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/asset/material.h"

namespace rowland::diffraction {

/// A material of these two JSON objects, and further members.
inline CookedMaterial cook(const std::string& grating, const std::string& quality, const std::string& others = "") {
    return cook_material(parse_json("{\"grating\":" + grating + ",\"quality\":" + quality + others + "}", "test"),
                         "test");
}

/// A planar material of these settings, with a stand-in of few views, as many are slow to bake for a lobe.
inline CookedMaterial cook_planar(const std::string& grating, const std::string& settings) {
    const std::string quality = R"({"representation": "planar", )" + settings + "}";
    const Material material =
        parse_material(parse_json("{\"grating\":" + grating + ",\"quality\":" + quality + "}", "test"), "test");
    auto planar = std::get<PlanarSettings>(*material.quality.pinned);
    if (planar.lobe_size) planar.stand_in.grid = view_grid(ViewMapping::Spherical, 4);
    CookedMaterial cooked = bake_kernel(material);
    cooked.tables = bake(material.grating, planar);
    return cooked;
}

}  // namespace rowland::diffraction

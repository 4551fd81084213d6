#pragma once

#include <glm/vec3.hpp>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/portable/document.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::diffraction {

/// Adds "probe": its key lights, and the raw SH of the rest of its light.
void add_probe(const EvaluationLight& light, int bands, PortableDocument& document);

/// Adds "planar": the map of a flat surface under the light without its key lights. The lobe is flat.
void add_planar_map(const CookedMaterial& cooked, const EvaluationLight& light, const glm::dvec3& normal,
                    const PlanarMapSize& size, PortableDocument& document);

}  // namespace rowland::diffraction

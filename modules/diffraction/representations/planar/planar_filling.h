#pragma once

#include <glm/mat3x3.hpp>
#include <memory>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/planar/planar.h"
#include "modules/diffraction/runtime/map_filling.h"

namespace rowland::diffraction {

/// Fills the maps of a material's objects: planar_map.glsl. `kernel`, `zero_order`: in the working space.
std::shared_ptr<const FillMap> planar_filling(const PlanarTables& tables, const KernelTable& kernel,
                                              const glm::dmat3& zero_order, const Grating& grating,
                                              const glm::dmat3& xyz_to_working);

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <memory>

#include "modules/diffraction/representations/planar/planar.h"
#include "modules/diffraction/representations/point_shader.h"
#include "modules/diffraction/runtime/map_filling.h"

namespace rowland::diffraction {

/// Fills the maps of a material's objects: planar_map.glsl. `material`: in the working space.
std::shared_ptr<const FillMap> planar_filling(const PlanarTables& tables, const MaterialKernel& material,
                                              const glm::dmat3& xyz_to_working);

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>

#include "engine/post/glare.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// What the eye sees through a grating or lattice held before it, g to the right: the points of its diffraction
/// pattern, PHYSICS (6.2), and order 0 straight through. Without its lobe: grooves are taken to be straight and
/// parallel. Colours are those of the working space, under D65.
post::GlarePattern glare_pattern(const Grating& grating, const glm::dmat3& xyz_to_working);

}  // namespace rowland::diffraction

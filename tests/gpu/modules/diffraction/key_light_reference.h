#pragma once

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/direct/direct.h"
#include "tests/gpu/modules/diffraction/drawn_triangle.h"

namespace rowland::diffraction {

/// XYZ of key lights at a point, with the kernel smoothed as on the GPU.
glm::dvec3 key_light_xyz(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys, const Point& point);
/// XYZ of order 0, if it is listed, which the smoothed kernel does not hold: a lobe's own density in s_g over the
/// pixel.
glm::dvec3 order_zero_xyz(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                          const Point& point);
/// What texture units may add to it (filter_error.h): of the lights' tables.
glm::dvec3 key_light_error(const CookedMaterial& cooked, const std::vector<lighting::KeyLight>& keys,
                           const Point& point);

DirectMaterial direct_material(const CookedMaterial& cooked);

/// The material's kernel as the GPU has it. Kept by the pitch: every grating of the tests has its own.
const BlurredKernel& smoothed(const CookedMaterial& cooked);

}  // namespace rowland::diffraction

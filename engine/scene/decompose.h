#pragma once

#include <glm/mat4x4.hpp>

#include "engine/scene/transform.h"

namespace rowland::scene {

struct Decomposition {
    Transform transform;
    bool sheared = false;  ///< the matrix differs from the transform's by more than rounding
};

/// The translation, rotation and scale of a finite affine matrix. A mirroring one gets a negative x scale; axes of no
/// length get scale 0 and any direction. Shear is lost: the axes are made perpendicular, x first.
Decomposition decompose(const glm::dmat4& matrix);

}  // namespace rowland::scene

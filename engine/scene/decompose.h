#pragma once

#include <glm/mat4x4.hpp>

#include "engine/scene/transform.h"

namespace rowland::scene {

struct Decomposition {
    Transform transform;
    bool sheared = false;  ///< the transform's matrix differs by more than rounding
};

/// The translation, rotation and scale of a finite affine matrix. A mirroring matrix gets a negative x scale; axes of
/// length zero get scale 0 and any direction. Shear is lost: the axes are made perpendicular, starting from x.
Decomposition decompose(const glm::dmat4& matrix);

}  // namespace rowland::scene

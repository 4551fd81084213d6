#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "engine/post/ocio_config.h"

namespace rowland::post {

/// The matrix from CIE XYZ (white colour::white_d65()) to the working space, which is the configuration's scene_linear
/// role; white stays neutral. ACEScg by colour::xyz_to_acescg(), then what OpenColorIO says by way of the role
/// aces_interchange, else of cie_xyz_d65_interchange if that is a scene space. A configuration without either does not
/// say what its colours are: ACEScg is assumed, with a warning in the log. Good to float precision, 1e-6. Throws Error
/// (input) if scene_linear is missing or is not linear.
glm::dmat3 xyz_to_scene_linear(const OcioConfig& config);

/// Luminance as a weighted sum of scene_linear components: the Y row of the inverse of xyz_to_scene_linear. White has
/// luminance 1. Throws as that does.
glm::vec3 luminance_weights(const OcioConfig& config);

}  // namespace rowland::post

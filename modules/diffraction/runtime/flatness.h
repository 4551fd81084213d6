#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/scene/mesh.h"

namespace rowland::diffraction {

/// Largest angle in radians between a flat mesh's normals and their mean: not visible at a map's resolution.
inline constexpr double kFlatness = 0.005;

/// The mesh's normal in object axes, if all its normals agree.
std::optional<glm::dvec3> flat_normal(const scene::Mesh& mesh);

}  // namespace rowland::diffraction

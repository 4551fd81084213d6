#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "engine/scene/mesh.h"

namespace rowland::diffraction {

/// Largest angle between a flat mesh's normals and their mean, radians: what light does not show within a map's cells.
inline constexpr double kFlatness = 0.005;

/// The mesh's one normal in its own axes, if all its normals agree.
std::optional<glm::dvec3> flat_normal(const scene::Mesh& mesh);

}  // namespace rowland::diffraction

#pragma once

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>

#include "engine/scene/mesh.h"

namespace rowland::diffraction {

/// Largest angle in radians between a flat mesh's normals and their mean: not visible at a map's resolution.
inline constexpr double kFlatness = 0.005;

/// The mesh's normal in object axes, if all its normals agree.
std::optional<glm::dvec3> flat_normal(const scene::Mesh& mesh);

/// The tangent of a flat mesh with its bitangent's sign, in object axes, if all its tangents agree.
std::optional<glm::vec4> common_tangent(const scene::Mesh& mesh);

}  // namespace rowland::diffraction

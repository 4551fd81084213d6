#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "engine/lighting/sh_light.h"
#include "engine/math/frame_rotation.h"
#include "engine/scene/mesh.h"

namespace rowland::diffraction {

/// The tangent frame (g, h, n) of a vertex in world space, as rows. `groove_rotation` (radians) turns g from the mesh's
/// tangent toward its bitangent, whose sign is the tangent's w.
glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec3& tangent, const glm::mat4& object_to_world);
glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec4& tangent, const glm::mat4& object_to_world,
                         double groove_rotation);

/// Step 1 of Lindsay & Agu 2006, fig. 5: the light's SH in every vertex's tangent frame. Returns vertices ×
/// bands² × 3 floats (RGB innermost). Multithreaded.
std::vector<float> rotate_to_vertices(const lighting::ShLight& light, const scene::Mesh& mesh,
                                      const glm::mat4& object_to_world, double groove_rotation = 0.0);

/// The same, multiplied by a constant matrix: vertices × projection.rows() × 3 floats. The light has the projection's
/// bands.
std::vector<float> project_to_vertices(const lighting::ShLight& light, const math::FrameProjection& projection,
                                       const scene::Mesh& mesh, const glm::mat4& object_to_world,
                                       double groove_rotation = 0.0);

}  // namespace rowland::diffraction

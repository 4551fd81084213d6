#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>

#include "engine/scene/mesh.h"

namespace rowland::render {

/// Axis-parallel box around a transformed box [Arvo 1990].
scene::Bounds transformed(const scene::Bounds& box, const glm::mat4& matrix);

/// Around all of them; null if there are none.
std::optional<scene::Bounds> united(std::span<const scene::Bounds> boxes);

/// Around a skinned mesh in a pose: a vertex is a weighted mean of its positions under single joints, so the joints'
/// boxes contain it.
scene::Bounds posed_bounds(const scene::Bounds& box, std::span<const glm::mat4> joints);

/// A camera's view volume as six planes that face inward [Gribb & Hartmann 2001].
class Frustum {
 public:
    explicit Frustum(const glm::mat4& view_projection);
    /// False only if the box is wholly outside one plane: some invisible boxes near a corner pass.
    bool may_see(const scene::Bounds& box) const;

 private:
    std::array<glm::vec4, 6> planes_;
};

}  // namespace rowland::render

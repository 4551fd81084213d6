#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace rowland::scene {

/// A perspective camera that looks from `eye` at `target`. World axes, metres.
struct Camera {
    glm::vec3 eye{0.0F, 0.0F, 1.0F};
    glm::vec3 target{0.0F};
    glm::vec3 up{0.0F, 1.0F, 0.0F};
    float vertical_field_of_view = 0.7F;  ///< radians
    float near_plane = 0.01F;
    float far_plane = 100.0F;

    glm::mat4 view() const;
    /// OpenGL clip space; `aspect` = width / height.
    glm::mat4 projection(float aspect) const;
};

}  // namespace rowland::scene

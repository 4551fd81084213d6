#include "engine/scene/camera.h"

#include <glm/gtc/matrix_transform.hpp>

namespace rowland::scene {

glm::mat4 Camera::view() const {
    return glm::lookAt(eye, target, up);
}

glm::mat4 Camera::projection(float aspect) const {
    return glm::perspective(vertical_field_of_view, aspect, near_plane, far_plane);
}

}  // namespace rowland::scene

#include "engine/render/world_bounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_access.hpp>

namespace rowland::render {

namespace {

scene::Bounds around(const scene::Bounds& a, const scene::Bounds& b) {
    return {glm::min(a.minimum, b.minimum), glm::max(a.maximum, b.maximum)};
}

}  // namespace

scene::Bounds transformed(const scene::Bounds& box, const glm::mat4& matrix) {
    const glm::vec3 centre = 0.5F * (box.minimum + box.maximum);
    const glm::vec3 half = 0.5F * (box.maximum - box.minimum);
    const glm::vec3 new_centre = glm::vec3(matrix * glm::vec4(centre, 1.0F));
    glm::vec3 new_half(0.0F);
    for (int axis = 0; axis < 3; ++axis) new_half += glm::abs(glm::vec3(matrix[axis])) * half[axis];
    return {new_centre - new_half, new_centre + new_half};
}

std::optional<scene::Bounds> united(std::span<const scene::Bounds> boxes) {
    std::optional<scene::Bounds> all;
    for (const scene::Bounds& box : boxes) all = all ? around(*all, box) : box;
    return all;
}

scene::Bounds posed_bounds(const scene::Bounds& box, std::span<const glm::mat4> joints) {
    if (joints.empty()) return box;
    scene::Bounds all = transformed(box, joints.front());
    for (const glm::mat4& joint : joints.subspan(1)) all = around(all, transformed(box, joint));
    return all;
}

Frustum::Frustum(const glm::mat4& view_projection) {
    const glm::vec4 w = glm::row(view_projection, 3);
    for (int axis = 0; axis < 3; ++axis) {
        planes_[static_cast<std::size_t>(2 * axis)] = w + glm::row(view_projection, axis);
        planes_[static_cast<std::size_t>(2 * axis + 1)] = w - glm::row(view_projection, axis);
    }
}

bool Frustum::may_see(const scene::Bounds& box) const {
    const glm::vec3 centre = 0.5F * (box.minimum + box.maximum);
    const glm::vec3 half = 0.5F * (box.maximum - box.minimum);
    for (const glm::vec4& plane : planes_) {
        const float reach = glm::dot(glm::abs(glm::vec3(plane)), half);
        if (glm::dot(glm::vec3(plane), centre) + plane.w < -reach) return false;
    }
    return true;
}

}  // namespace rowland::render

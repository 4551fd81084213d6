#include "engine/scene/mesh.h"

#include <glm/common.hpp>

namespace rowland::scene {

Bounds bounds(const Mesh& mesh) {
    if (mesh.positions.empty()) return {};
    Bounds box{mesh.positions.front(), mesh.positions.front()};
    for (const glm::vec3& position : mesh.positions) {
        box.minimum = glm::min(box.minimum, position);
        box.maximum = glm::max(box.maximum, position);
    }
    return box;
}

}  // namespace rowland::scene

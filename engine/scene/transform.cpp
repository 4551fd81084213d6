#include "engine/scene/transform.h"

#include <glm/gtc/matrix_transform.hpp>

namespace rowland::scene {

namespace {

constexpr int kMaximumDepth = 256;

glm::mat4 world_matrix(ecs::World& world, ecs::Entity entity) {
    glm::mat4 matrix = world.get<Transform>(entity).matrix();
    for (int depth = 0;; ++depth) {
        ROWLAND_CHECK(depth < kMaximumDepth, "transforms form a cycle, or a chain deeper than 256");
        const Parent* parent = world.find<Parent>(entity);
        if (parent == nullptr) return matrix;
        entity = parent->entity;
        if (const Transform* transform = world.find<Transform>(entity)) matrix = transform->matrix() * matrix;
    }
}

}  // namespace

glm::mat4 Transform::matrix() const {
    return glm::translate(glm::mat4(1.0F), translation) * glm::mat4_cast(rotation) * glm::scale(glm::mat4(1.0F), scale);
}

void update_world_matrices(ecs::World& world) {
    world.view<Transform>().each(
        [&world](ecs::Entity entity, Transform&) { world.add(entity, WorldMatrix{world_matrix(world, entity)}); });
}

}  // namespace rowland::scene

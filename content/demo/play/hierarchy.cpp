#include "content/demo/play/hierarchy.h"

#include "engine/scene/node_label.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

ecs::Entity parent_of(ecs::World& world, ecs::Entity entity) {
    const auto* parent = world.find<scene::Parent>(entity);
    return parent == nullptr ? ecs::Entity{} : parent->entity;
}

glm::mat4 object_to_world(ecs::World& world, ecs::Entity entity) {
    glm::mat4 matrix(1.0F);
    for (; world.alive(entity); entity = parent_of(world, entity))
        if (const auto* transform = world.find<scene::Transform>(entity)) matrix = transform->matrix() * matrix;
    return matrix;
}

std::string name_of_object(ecs::World& world, ecs::Entity entity) {
    for (; world.alive(entity); entity = parent_of(world, entity))
        if (const auto* label = world.find<scene::NodeLabel>(entity); label != nullptr && !label->name.empty())
            return label->name;
    return "grating";
}

}  // namespace rowland::demo

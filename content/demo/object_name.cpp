#include "content/demo/object_name.h"

#include "engine/scene/node_label.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

std::string name_of_object(ecs::World& world, ecs::Entity entity) {
    while (world.alive(entity)) {
        if (const auto* label = world.find<scene::NodeLabel>(entity); label != nullptr && !label->name.empty())
            return label->name;
        const auto* parent = world.find<scene::Parent>(entity);
        if (parent == nullptr) break;
        entity = parent->entity;
    }
    return "grating";
}

}  // namespace rowland::demo

#include "content/demo/object_name.h"

#include "content/demo/play/pick.h"
#include "engine/scene/node_label.h"

namespace rowland::demo {

std::string name_of_object(ecs::World& world, ecs::Entity entity) {
    for (; world.alive(entity); entity = parent_of(world, entity))
        if (const auto* label = world.find<scene::NodeLabel>(entity); label != nullptr && !label->name.empty())
            return label->name;
    return "grating";
}

}  // namespace rowland::demo

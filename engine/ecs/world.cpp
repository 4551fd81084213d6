#include "engine/ecs/world.h"

#include <atomic>

namespace rowland::ecs {

std::size_t detail::next_component_id() {
    static std::atomic<std::size_t> next{0};
    return next++;
}

Entity World::create() {
    if (free_.empty()) {
        versions_.push_back(0);
        retired_.push_back(false);
        return {static_cast<std::uint32_t>(versions_.size() - 1), 0};
    }
    const std::uint32_t index = free_.back();
    free_.pop_back();
    retired_[index] = false;
    return {index, versions_[index]};
}

void World::destroy(Entity entity) {
    ROWLAND_CHECK(alive(entity), "destroy() of an entity that is not alive");
    for (const auto& pool : pools_)
        if (pool) pool->erase(entity.index);
    retired_[entity.index] = true;
    ++versions_[entity.index];
    free_.push_back(entity.index);
}

}  // namespace rowland::ecs

#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"

namespace rowland::ecs {

/// Structural changes recorded while a view iterates, applied afterwards in the order they were recorded. A change to
/// an entity that an earlier one destroyed is dropped.
class Commands {
 public:
    void destroy(Entity entity) {
        record([entity](World& world) {
            if (world.alive(entity)) world.destroy(entity);
        });
    }
    template <typename T>
    void add(Entity entity, T component) {
        record([entity, component = std::move(component)](World& world) {
            if (world.alive(entity)) world.add<T>(entity, component);
        });
    }
    template <typename T>
    void remove(Entity entity) {
        record([entity](World& world) {
            if (world.alive(entity)) world.remove<T>(entity);
        });
    }
    /// Applies and forgets everything recorded.
    void apply(World& world) {
        for (const auto& change : std::exchange(changes_, {})) change(world);
    }

 private:
    void record(std::function<void(World&)> change) { changes_.push_back(std::move(change)); }

    std::vector<std::function<void(World&)>> changes_;
};

}  // namespace rowland::ecs

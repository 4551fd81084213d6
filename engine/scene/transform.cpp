#include "engine/scene/transform.h"

#include <glm/gtc/matrix_transform.hpp>
#include <vector>

#include "engine/core/check.h"

namespace rowland::scene {

namespace {

/// Computes each world matrix once, without recursion: a scene from a file may hold chains of parents of any depth.
class Placement {
 public:
    explicit Placement(ecs::World& world) : world_(world) {}

    void update(ecs::Entity entity) {
        glm::mat4 above = collect_chain(entity);
        for (; !chain_.empty(); chain_.pop_back()) {
            const ecs::Entity next = chain_.back();
            state_of(next) = State::Unknown;
            const Transform* transform = world_.find<Transform>(next);
            if (transform == nullptr) continue;
            above *= transform->matrix();
            world_.add(next, WorldMatrix{above});
            state_of(next) = State::Placed;
        }
    }

 private:
    enum class State : std::uint8_t { Unknown, InChain, Placed };

    State& state_of(ecs::Entity entity) {
        if (entity.index >= states_.size()) states_.resize(std::size_t{entity.index} + 1, State::Unknown);
        return states_[entity.index];
    }

    /// Fills the chain with `entity` and its ancestors, up to the root or to one that is placed; returns the latter's
    /// matrix.
    glm::mat4 collect_chain(ecs::Entity entity) {
        while (world_.alive(entity)) {
            State& state = state_of(entity);
            if (state == State::Placed) return world_.get<WorldMatrix>(entity).matrix;
            ROWLAND_CHECK(state != State::InChain, "transforms form a cycle");
            state = State::InChain;
            chain_.push_back(entity);
            const Parent* parent = world_.find<Parent>(entity);
            if (parent == nullptr) break;
            entity = parent->entity;
        }
        return glm::mat4(1.0F);
    }

    ecs::World& world_;
    std::vector<State> states_;  ///< by the entity's index
    std::vector<ecs::Entity> chain_;
};

}  // namespace

glm::mat4 Transform::matrix() const {
    return glm::translate(glm::mat4(1.0F), translation) * glm::mat4_cast(rotation) * glm::scale(glm::mat4(1.0F), scale);
}

void update_world_matrices(ecs::World& world) {
    Placement placement(world);
    world.view<Transform>().each([&placement](ecs::Entity entity, Transform&) { placement.update(entity); });
}

}  // namespace rowland::scene

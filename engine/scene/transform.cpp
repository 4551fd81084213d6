#include "engine/scene/transform.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "engine/core/check.h"
#include "engine/scene/mesh.h"

namespace rowland::scene {

namespace {

/// Computes each world matrix once, without recursion: a scene from a file may hold chains of parents of any depth.
class WorldMatrices {
 public:
    explicit WorldMatrices(ecs::World& world) : world_(world) {}

    void update(ecs::Entity entity) {
        glm::mat4 matrix = collect_chain(entity);
        for (; !chain_.empty(); chain_.pop_back()) {
            const ecs::Entity next = chain_.back();
            state_of(next) = State::Unknown;
            const Transform* transform = world_.find<Transform>(next);
            if (transform == nullptr) continue;
            matrix *= transform->matrix();
            world_.add(next, WorldMatrix{matrix});
            state_of(next) = State::Known;
        }
    }

 private:
    enum class State : std::uint8_t { Unknown, InChain, Known };

    State& state_of(ecs::Entity entity) {
        if (entity.index >= states_.size()) states_.resize(std::size_t{entity.index} + 1, State::Unknown);
        return states_[entity.index];
    }

    /// Fills chain_ with `entity` and its ancestors up to one with a known matrix; returns that, else the identity.
    glm::mat4 collect_chain(ecs::Entity entity) {
        while (world_.alive(entity)) {
            State& state = state_of(entity);
            if (state == State::Known) return world_.get<WorldMatrix>(entity).matrix;
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
    WorldMatrices matrices(world);
    world.view<Transform>().each([&matrices](ecs::Entity entity, Transform&) { matrices.update(entity); });
}

namespace {

// Tolerance relative to the largest axis: files hold floats, some written with six digits.
constexpr double kRounding = 1e-5;

/// The unit vector along the part of `axis` perpendicular to `x` and `y`, which are unit or zero; zero if there is
/// none.
glm::dvec3 perpendicular_part(glm::dvec3 axis, const glm::dvec3& x, const glm::dvec3& y) {
    const double length = glm::length(axis);
    if (!(length > 0.0)) return glm::dvec3(0.0);
    axis /= length;
    axis -= glm::dot(axis, x) * x;
    axis -= glm::dot(axis, y) * y;
    const double remaining = glm::length(axis);
    return remaining > kRounding ? axis / remaining : glm::dvec3(0.0);
}

bool is_zero(const glm::dvec3& v) {
    return v == glm::dvec3(0.0);
}

/// Right-handed rotation whose axes follow the columns that are not zero.
glm::dmat3 rotation_along(const glm::dmat3& linear) {
    const glm::dvec3 none(0.0);
    glm::dvec3 x = perpendicular_part(linear[0], none, none);
    glm::dvec3 y = perpendicular_part(linear[1], x, none);
    glm::dvec3 z = perpendicular_part(linear[2], x, y);
    // One missing axis follows from the other two; the first of two missing ones is any perpendicular vector.
    if (is_zero(x) && is_zero(y) && is_zero(z)) return glm::dmat3(1.0);
    const auto any = [](const glm::dvec3& a) { return glm::dvec3(any_perpendicular(glm::vec3(a))); };
    if (is_zero(x) && is_zero(y)) x = perpendicular_part(any(z), z, none);
    if (is_zero(x) && is_zero(z)) x = perpendicular_part(any(y), y, none);
    if (is_zero(y) && is_zero(z)) y = perpendicular_part(any(x), x, none);
    if (is_zero(x)) x = glm::cross(y, z);
    if (is_zero(y)) y = glm::cross(z, x);
    if (is_zero(z)) z = glm::cross(x, y);
    if (glm::dot(glm::cross(x, y), z) < 0.0) x = -x;
    return {x, y, z};
}

}  // namespace

Decomposition decompose(const glm::dmat4& matrix) {
    const glm::dmat3 linear(matrix);
    const glm::dmat3 rotation = rotation_along(linear);
    glm::dvec3 scale;
    double largest = 0.0;
    double error = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double length = glm::length(linear[axis]);
        scale[axis] = glm::dot(linear[axis], rotation[axis]) < 0.0 ? -length : length;
        largest = std::max(largest, length);
        error = std::max(error, glm::length(linear[axis] - rotation[axis] * scale[axis]));
    }
    Decomposition parts;
    parts.transform.translation = glm::vec3(matrix[3]);
    parts.transform.rotation = glm::quat(glm::quat_cast(rotation));
    parts.transform.scale = glm::vec3(scale);
    parts.sheared = error > kRounding * largest;
    return parts;
}

}  // namespace rowland::scene

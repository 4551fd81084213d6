#include "content/demo/play/body.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

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
        if (const auto* label = world.find<scene::NodeMetadata>(entity); label != nullptr && !label->name.empty())
            return label->name;
    return "grating";
}

namespace {

constexpr double kLift_s = 0.12;  ///< time constant

glm::dquat idle_turn(const Body& body) {
    if (!body.spin_axis) return {1.0, 0.0, 0.0, 0.0};
    const double angle = std::fmod(body.idle_spin * body.state.idle_s, 2.0 * std::numbers::pi);
    return glm::angleAxis(angle, glm::dvec3(*body.spin_axis));
}

}  // namespace

glm::dquat rotation_of(const Body& body) {
    return body.state.turned * glm::dquat(body.rest.rotation) * idle_turn(body);
}

glm::dvec3 own_axis(const Body& body) {
    return rotation_of(body) * glm::dvec3(body.spin_axis.value_or(glm::vec3(0.0F, 1.0F, 0.0F)));
}

void turn(Body& body, const glm::dquat& rotation) {
    body.state.turned = glm::normalize(rotation * body.state.turned);
}

void step(Body& body, double seconds) {
    BodyState& state = body.state;
    if (body.spin_axis && !state.touched) state.idle_s += seconds;
    const double speed = glm::length(state.spin);
    if (speed == 0.0) return;
    // dw/dt = -w / decay: the angle of a step is the integral of the speed over it.
    const double lost = -std::expm1(-seconds / kSpinDecay_s);
    turn(body, glm::angleAxis(speed * kSpinDecay_s * lost, state.spin / speed));
    constexpr double kRest = 1e-3;  // radians per second, too slow to see
    state.spin = speed > kRest ? state.spin * (1.0 - lost) : glm::dvec3(0.0);
}

void step_lift(Body& body, double seconds) {
    const double goal = body.state.raised ? 1.0 : 0.0;
    body.state.lift += (goal - body.state.lift) * -std::expm1(-seconds / kLift_s);
    constexpr double kThere = 1e-4;
    if (std::abs(goal - body.state.lift) < kThere) body.state.lift = goal;
}

scene::Transform transform_of(const Body& body, const glm::vec3& up) {
    scene::Transform now = body.rest;
    if (body.state == BodyState{}) return now;
    now.rotation = glm::quat(rotation_of(body));
    // The centre stays where it is, but for the lift.
    const glm::vec3 arm = body.rest.scale * body.centre;
    now.translation += body.rest.rotation * arm - now.rotation * arm;
    now.translation += static_cast<float>(body.state.lift) * body.clearance * up;
    return now;
}

void update_node(ecs::World& world, const Body& body) {
    const glm::mat3 parent_to_world(object_to_world(world, parent_of(world, body.node)));
    const glm::vec3 up = glm::inverse(parent_to_world) * glm::vec3(0.0F, 1.0F, 0.0F);
    world.get<scene::Transform>(body.node) = transform_of(body, up);
}

std::optional<Hit> pick(ecs::World& world, std::span<const PickTarget> targets, const Ray& ray) {
    std::optional<Hit> nearest;
    for (std::size_t i = 0; i < targets.size(); ++i) {
        if (!world.alive(targets[i].entity)) continue;
        const glm::mat4 to_world = object_to_world(world, targets[i].entity);
        if (glm::determinant(to_world) == 0.0F) continue;
        const glm::mat4 to_mesh = glm::inverse(to_world);
        // The direction keeps its length in the mesh's space, so that distances stay metres.
        const Ray local{glm::vec3(to_mesh * glm::vec4(ray.origin, 1.0F)), glm::mat3(to_mesh) * ray.direction};
        if (!scene::meets(local, targets[i].bounds)) continue;
        const auto hit = nearest_hit(local, *targets[i].mesh);
        if (!hit || (nearest && hit->distance >= nearest->triangle.distance)) continue;
        nearest = {.target = i, .triangle = *hit, .point = ray.origin + hit->distance * ray.direction};
    }
    return nearest;
}

}  // namespace rowland::demo

#include "content/demo/toys_of_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "content/demo/play/body.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/transform.h"

namespace rowland::demo {

namespace {

constexpr double kIdleSpin = 20.0 / 180.0 * std::numbers::pi;

std::optional<glm::vec3> spin_axis(const nlohmann::json& extras) {
    if (!extras.is_object() || !extras.contains("spin_axis")) return std::nullopt;
    const nlohmann::json& given = extras["spin_axis"];
    if (!given.is_array() || given.size() != 3) return std::nullopt;
    glm::dvec3 axis(0.0);
    for (int i = 0; i < 3; ++i) {
        const nlohmann::json& component = given[static_cast<std::size_t>(i)];
        if (!component.is_number()) return std::nullopt;
        axis[i] = component.get<double>();
    }
    const double length = glm::length(axis);
    if (!(length > 0.0) || !std::isfinite(length)) return std::nullopt;
    return glm::vec3(axis / length);
}

bool is_below(ecs::World& world, ecs::Entity entity, ecs::Entity node) {
    while (world.alive(entity) && entity != node) entity = parent_of(world, entity);
    return entity == node;
}

/// All vertices below a node, in the world.
std::vector<glm::vec3> vertices_below(ecs::World& world, ecs::Entity node) {
    std::vector<glm::vec3> vertices;
    world.view<render::MeshInstance>().each([&](ecs::Entity entity, const render::MeshInstance& instance) {
        if (instance.gpu->is_skinned() || !is_below(world, entity, node)) return;
        const glm::mat4 to_world = object_to_world(world, entity);
        for (const glm::vec3& position : instance.mesh->positions)
            vertices.emplace_back(to_world * glm::vec4(position, 1.0F));
    });
    return vertices;
}

}  // namespace

Body body_of(ecs::World& world, ecs::Entity node) {
    Body body;
    body.node = node;
    body.rest = world.get<scene::Transform>(node);
    const std::vector<glm::vec3> vertices = vertices_below(world, node);
    if (vertices.empty()) return body;
    glm::vec3 lowest = vertices.front();
    glm::vec3 highest = lowest;
    for (const glm::vec3& vertex : vertices) {
        lowest = glm::min(lowest, vertex);
        highest = glm::max(highest, vertex);
    }
    const glm::vec3 centre = 0.5F * (lowest + highest);
    for (const glm::vec3& vertex : vertices) body.radius = std::max(body.radius, glm::length(vertex - centre));
    body.centre = glm::vec3(glm::inverse(object_to_world(world, node)) * glm::vec4(centre, 1.0F));
    // Its bounding sphere must clear what it lies on, and the stand that holds its foot.
    constexpr float kStandInRadii = 0.25F;
    body.clearance = std::max(0.0F, body.radius - (centre.y - lowest.y)) + kStandInRadii * body.radius;
    return body;
}

std::vector<Body> bodies_of(ecs::World& world, const render::SceneInstance& instance) {
    std::vector<Body> bodies;
    for (const ecs::Entity node : instance.nodes) {
        const auto& label = world.get<scene::NodeLabel>(node);
        const auto axis = spin_axis(label.extras);
        const bool grab = scene::is_marked(label.extras, "grab");
        if (!axis && !grab) continue;
        Body body = body_of(world, node);
        body.name = label.name;
        body.spin_axis = axis;
        body.idle_spin = axis ? kIdleSpin : 0.0;
        body.grab = grab;
        bodies.push_back(std::move(body));
    }
    return bodies;
}

void add_targets(ecs::World& world, Toys& toys) {
    const auto body_above = [&](ecs::Entity entity) -> std::optional<std::size_t> {
        for (; world.alive(entity); entity = parent_of(world, entity))
            for (std::size_t i = 0; i < toys.bodies.size(); ++i)
                if (toys.bodies[i].grab && toys.bodies[i].node == entity) return i;
        return std::nullopt;
    };
    world.view<render::MeshInstance>().each([&](ecs::Entity entity, const render::MeshInstance& instance) {
        if (instance.gpu->is_skinned()) return;
        toys.targets.push_back({entity, instance.mesh, instance.gpu->bounds()});
        toys.body_of_target.push_back(body_above(entity));
    });
}

}  // namespace rowland::demo

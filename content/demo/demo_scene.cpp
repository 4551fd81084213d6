#include "content/demo/demo_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <utility>

#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/spike_surface.h"

namespace rowland::demo {

namespace {

constexpr float kSphereRadius = 0.025F;
constexpr float kDiscHeight = 0.052F;
constexpr float kOwnMeshSize = 0.12F;

glm::quat about(const glm::vec3& axis, double degrees) {
    return glm::angleAxis(static_cast<float>(degrees * std::numbers::pi / 180.0), axis);
}

}  // namespace

void fit_to_box(scene::Mesh& mesh, float size_m) {
    const scene::Bounds box = scene::bounds(mesh);
    const glm::vec3 extent = box.maximum - box.minimum;
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = largest > 0.0F ? size_m / largest : 1.0F;
    const glm::vec3 foot((box.minimum.x + box.maximum.x) * 0.5F, box.minimum.y, (box.minimum.z + box.maximum.z) * 0.5F);
    for (glm::vec3& position : mesh.positions) position = (position - foot) * scale;
}

DemoScene::DemoScene(SceneSources sources) : disc_(sources.grating_is_disc) {
    camera_.eye = {0.0F, 0.14F, 0.38F};
    camera_.target = {0.0F, 0.047F, 0.0F};
    camera_.vertical_field_of_view = kFieldOfView;
    add_grating(sources);
    add_spheres(std::move(sources.sphere));
    add_ground(std::move(sources.ground));
    advance_to(0.0);
}

void DemoScene::advance_to(double seconds) {
    // The CD leans back and rocks, so that its colours wander; a mesh of the user's turns like on a plate.
    const double lean = 52.0 + 12.0 * std::sin(0.7 * seconds);
    world_.get<scene::Transform>(stand_).rotation = disc_ ? about({1.0F, 0.0F, 0.0F}, lean) : glm::quat(1, 0, 0, 0);
    world_.get<scene::Transform>(grating_).rotation = about({0.0F, 1.0F, 0.0F}, (disc_ ? 40.0 : 25.0) * seconds);
    scene::update_world_matrices(world_);
}

void DemoScene::add_grating(SceneSources& sources) {
    if (!disc_) fit_to_box(sources.grating, kOwnMeshSize);
    stand_ = world_.create();
    world_.add(stand_, scene::Transform{.translation = {0.0F, disc_ ? kDiscHeight : 0.0F, 0.0F}});
    grating_ = world_.create();
    world_.add(grating_, scene::Transform{});
    world_.add(grating_, scene::Parent{stand_});
    world_.add(grating_, render::make_mesh_instance(std::move(sources.grating)));
    world_.add(grating_, sources.material->base());
    world_.add(grating_, diffraction::SpikeSurface{sources.material});
}

void DemoScene::add_spheres(scene::Mesh sphere) {
    fit_to_box(sphere, 2.0F * kSphereRadius);
    const render::MeshInstance instance = render::make_mesh_instance(std::move(sphere));
    const auto add = [&](float x, const render::StandardMaterial& material) {
        const ecs::Entity entity = world_.create();
        world_.add(entity, scene::Transform{.translation = {x, 0.0F, 0.02F}});
        world_.add(entity, instance);
        world_.add(entity, material);
    };
    add(-0.092F, {.base_colour = glm::vec3(0.75F), .metallic = 0.0F, .roughness = 1.0F});
    add(0.092F, {.base_colour = glm::vec3(0.95F, 0.93F, 0.88F), .metallic = 1.0F, .roughness = 0.12F});
}

void DemoScene::add_ground(scene::Mesh ground) {
    const ecs::Entity entity = world_.create();
    world_.add(entity, scene::Transform{});
    world_.add(entity, render::make_mesh_instance(std::move(ground)));
    world_.add(entity, render::StandardMaterial{.base_colour = glm::vec3(0.18F), .metallic = 0.0F, .roughness = 0.6F});
}

}  // namespace rowland::demo

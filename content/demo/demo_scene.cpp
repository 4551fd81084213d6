#include "content/demo/demo_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "content/demo/opening_view.h"
#include "content/demo/toys_of_scene.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/render/world_bounds.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

constexpr float kSphereRadius = 0.025F;
constexpr float kDiscHeight = 0.052F;
constexpr float kOwnMeshSize = 0.12F;
constexpr double kDiscSpin = 40.0 / 180.0 * std::numbers::pi;
constexpr float kLift = 5e-4F;  ///< metres; a flat scene must not share the ground's plane

glm::quat about(const glm::vec3& axis, double degrees) {
    return glm::angleAxis(static_cast<float>(degrees * std::numbers::pi / 180.0), axis);
}

/// How something that fills `box` is scaled and moved to stand on the origin within a cube of the given size.
scene::Transform fitting(const scene::Bounds& box, float size_m) {
    const glm::vec3 extent = box.maximum - box.minimum;
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = largest > 0.0F ? size_m / largest : 1.0F;
    const glm::vec3 foot((box.minimum.x + box.maximum.x) * 0.5F, box.minimum.y, (box.minimum.z + box.maximum.z) * 0.5F);
    return {.translation = -scale * foot, .rotation = {1.0F, 0.0F, 0.0F, 0.0F}, .scale = glm::vec3(scale)};
}

/// The bounds of everything that can be pointed at, in the world.
scene::Bounds bounds_of(ecs::World& world, const std::vector<PickTarget>& targets) {
    std::vector<scene::Bounds> boxes;
    for (const PickTarget& target : targets)
        boxes.push_back(render::transformed(target.bounds, placement(world, target.entity)));
    return render::united(boxes).value_or(scene::Bounds{});
}

}  // namespace

void fit_to_box(scene::Mesh& mesh, float size_m) {
    const scene::Transform fit = fitting(scene::bounds(mesh), size_m);
    for (glm::vec3& position : mesh.positions) position = fit.scale * position + fit.translation;
}

DemoScene::DemoScene(const Options& options, LiveAssets& assets, render::Renderer& renderer,
                     const glm::dmat3& xyz_to_working)
    : renderer_(renderer), xyz_to_working_(xyz_to_working), disc_(!options.mesh && !options.scene) {
    camera_.eye = {0.0F, 0.14F, 0.38F};
    camera_.target = {0.0F, 0.047F, 0.0F};
    camera_.vertical_field_of_view = kFieldOfView;

    root_ = world_.create();
    world_.add(root_, scene::Transform{});
    stand_ = world_.create();
    world_.add(stand_, scene::Transform{.translation = {0.0F, disc_ ? kDiscHeight : 0.0F, 0.0F}});
    add_under_root(stand_);
    grating_ = world_.create();
    world_.add(grating_, scene::Transform{});
    world_.add(grating_, scene::Parent{stand_});
    if (options.scene) {
        scene_file_ = options.scene->string();
        scene_ = {assets.scene(*options.scene)};
        own_view_ = !scene_.handle->cameras.empty();
        if (own_view_) camera_ = all_views(*scene_.handle, scene::merge_instances(*scene_.handle)).front();
        show_scene();
    } else {
        grating_mesh_ = {assets.scene(options.mesh.value_or(options.cooked_folder / "cd.glb"))};
        material_ = {assets.load<diffraction::CookedMaterial>(
            options.material.value_or(options.cooked_folder / "cd.material"), diffraction::kMaterialAssetType,
            diffraction::read_cooked_material)};
        show_grating_mesh();
        show_grating_material();
    }
    if (!own_view_) add_surroundings(options, assets);
    failures_.clear();
    refresh();
    set_sun(options.sun);
}

void DemoScene::add_under_root(ecs::Entity entity) {
    world_.add(entity, scene::Parent{root_});
}

void DemoScene::add_surroundings(const Options& options, LiveAssets& assets) {
    sphere_mesh_ = {assets.scene(options.cooked_folder / "sphere.glb")};
    ground_mesh_ = {assets.scene(options.cooked_folder / "ground.glb")};
    add_spheres();
    ground_ = add_mesh_entity(
        {}, render::StandardMaterial{.base_colour = glm::vec3(0.18F), .metallic = 0.0F, .roughness = 0.6F});
}

template <typename T, typename F>
void DemoScene::refresh(Shown<T>& shown, F&& show) {
    if (!shown.handle || shown.version == shown.handle.version()) return;
    shown.version = shown.handle.version();
    try {
        show();
    } catch (const Error& error) {
        log_error("{}", error.what());
        failures_.emplace_back(error.what());
    }
}

bool DemoScene::refresh() {
    failures_.clear();
    meshes_changed_ = false;
    refresh(scene_, [this] { show_scene(); });
    refresh(grating_mesh_, [this] { show_grating_mesh(); });
    refresh(material_, [this] { show_grating_material(); });
    refresh(sphere_mesh_, [this] { show_spheres(); });
    refresh(ground_mesh_, [this] { show_ground(); });
    return meshes_changed_;
}

void DemoScene::show_scene() {
    scene_.version = scene_.handle.version();
    const scene::ImportedScene& imported = *scene_.handle;
    render::SceneInstance instance = render::instantiate(world_, imported, renderer_, scene_file_);
    if (instance_) render::destroy(world_, *instance_);
    instance_ = std::move(instance);
    meshes_changed_ = true;
    for (const ecs::Entity node : instance_->nodes)
        if (world_.find<scene::Parent>(node) == nullptr) world_.add(node, scene::Parent{own_view_ ? root_ : grating_});
    if (!own_view_) fit_scene(scene::merge_instances(imported));
}

void DemoScene::fit_scene(const scene::Mesh& merged) {
    // The whole scene is fitted by the entity that turns it; its size is that of the scene at rest.
    scene::Transform fit = fitting(scene::bounds(merged), kOwnMeshSize);
    fit.translation.y += kLift;
    world_.get<scene::Transform>(grating_) = fit;
}

void DemoScene::show_grating_mesh() {
    grating_mesh_.version = grating_mesh_.handle.version();
    scene::Mesh mesh = scene::merge_instances(*grating_mesh_.handle);
    if (!disc_) fit_to_box(mesh, kOwnMeshSize);
    world_.add(grating_, render::make_mesh_instance(std::move(mesh)));
    meshes_changed_ = true;
}

void DemoScene::show_grating_material() {
    material_.version = material_.handle.version();
    auto material = diffraction::make_gpu_material(*material_.handle, xyz_to_working_);
    world_.add(grating_, material->base());
    world_.add(grating_, diffraction::DiffractionSurface{std::move(material)});
}

ecs::Entity DemoScene::add_mesh_entity(const glm::vec3& place, const render::StandardMaterial& surface) {
    const ecs::Entity entity = world_.create();
    world_.add(entity, scene::Transform{.translation = place});
    add_under_root(entity);
    world_.add(entity, surface);
    return entity;
}

void DemoScene::add_spheres() {
    spheres_ = {
        add_mesh_entity({-0.092F, 0.0F, 0.02F}, {.base_colour = glm::vec3(0.75F), .metallic = 0.0F, .roughness = 1.0F}),
        add_mesh_entity({0.092F, 0.0F, 0.02F},
                        {.base_colour = glm::vec3(0.95F, 0.93F, 0.88F), .metallic = 1.0F, .roughness = 0.12F})};
}

void DemoScene::show_spheres() {
    scene::Mesh sphere = scene::merge_instances(*sphere_mesh_.handle);
    fit_to_box(sphere, 2.0F * kSphereRadius);
    const render::MeshInstance instance = render::make_mesh_instance(std::move(sphere));
    for (const ecs::Entity entity : spheres_) world_.add(entity, instance);
    meshes_changed_ = true;
}

void DemoScene::show_ground() {
    world_.add(ground_, render::make_mesh_instance(scene::merge_instances(*ground_mesh_.handle)));
    meshes_changed_ = true;
}

void DemoScene::set_sun(bool on) {
    if (on == sun()) return;
    if (!on) {
        world_.destroy(sun_);
        return;
    }
    sun_ = world_.create();
    world_.add(sun_, scene::Transform{});
    add_under_root(sun_);
    world_.add(sun_, scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.55F, 0.8F, 0.35F)),
                                             .irradiance = glm::vec3(2.5F, 2.4F, 2.2F),
                                             .casts_shadow = true});
}

Toys DemoScene::toys() {
    Toys toys{.root = root_, .bodies = {}, .targets = {}, .body_of_target = {}};
    pose_stand();
    if (instance_) toys.bodies = bodies_of(world_, *instance_);
    if (!own_view_) {
        Body grating = body_of(world_, grating_);
        grating.name = "grating";
        grating.grab = true;
        if (disc_) {
            grating.spin_axis = {0.0F, 1.0F, 0.0F};
            grating.idle_spin = kDiscSpin;
        }
        toys.bodies.insert(toys.bodies.begin(), std::move(grating));
    }
    add_targets(world_, toys);
    return toys;
}

void DemoScene::pose_stand() {
    // The CD leans back and rocks, so that its colours wander; what is the user's turns like on a plate.
    const double lean = 52.0 + 12.0 * std::sin(0.7 * stand_s_);
    world_.get<scene::Transform>(stand_).rotation =
        disc_ ? about({1.0F, 0.0F, 0.0F}, lean) : about({0.0F, 1.0F, 0.0F}, 25.0 * stand_s_);
}

void DemoScene::pose(const Play& play) {
    const double elapsed = play.time_s() - posed_s_;
    posed_s_ = play.time_s();
    // What is held must not turn under the hand.
    if (own_view_ || !play.bodies().front().state.touched) stand_s_ += elapsed;
    pose_stand();
    if (!instance_ || instance_->animations.empty()) return;
    const float duration = instance_->animations[0].duration_s;
    const double time = duration > 0.0F ? std::fmod(play.time_s(), static_cast<double>(duration)) : 0.0;
    instance_->animate(world_, 0, static_cast<float>(time));
}

scene::Bounds DemoScene::room() {
    Toys all;
    add_targets(world_, all);
    scene::Bounds box = bounds_of(world_, all.targets);
    const float distance = glm::length(camera_.target - camera_.eye);
    constexpr float kAround = 3.0F;
    constexpr float kLowestEye = 0.05F;
    const glm::vec3 around(kAround * distance);
    const float floor = box.minimum.y + kLowestEye * distance;
    box.minimum = glm::min(box.minimum, camera_.target - around);
    box.maximum = glm::max(box.maximum, camera_.target + around);
    box.minimum.y = std::min(floor, camera_.eye.y);
    return box;
}

std::vector<scene::Camera> DemoScene::views() const {
    if (!own_view_) return {camera_};
    return all_views(*scene_.handle, scene::merge_instances(*scene_.handle));
}

}  // namespace rowland::demo

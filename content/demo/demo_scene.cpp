#include "content/demo/demo_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <utility>

#include "content/demo/opening_view.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/node_label.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::demo {

namespace {

constexpr float kSphereRadius = 0.025F;
constexpr float kDiscHeight = 0.052F;
constexpr float kOwnMeshSize = 0.12F;
constexpr double kSpinDegreesPerSecond = 20.0;
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

/// The unit axis that a node's extras name, if they do; anything else under that key is not for us.
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

}  // namespace

void fit_to_box(scene::Mesh& mesh, float size_m) {
    const scene::Transform fit = fitting(scene::bounds(mesh), size_m);
    for (glm::vec3& position : mesh.positions) position = fit.scale * position + fit.translation;
}

DemoScene::DemoScene(const Options& options, Assets& assets, render::Renderer& renderer,
                     const glm::dmat3& xyz_to_working)
    : renderer_(renderer), xyz_to_working_(xyz_to_working), disc_(!options.mesh && !options.scene) {
    camera_.eye = {0.0F, 0.14F, 0.38F};
    camera_.target = {0.0F, 0.047F, 0.0F};
    camera_.vertical_field_of_view = kFieldOfView;

    stand_ = world_.create();
    world_.add(stand_, scene::Transform{.translation = {0.0F, disc_ ? kDiscHeight : 0.0F, 0.0F}});
    grating_ = world_.create();
    world_.add(grating_, scene::Transform{});
    world_.add(grating_, scene::Parent{stand_});
    if (options.scene) {
        scene_file_ = options.scene->string();
        scene_ = {assets.scene(*options.scene)};
        own_view_ = !scene_.handle->cameras.empty();
        if (own_view_) camera_ = opening_view(*scene_.handle, scene::merge_instances(*scene_.handle));
        show_scene();
    } else {
        grating_mesh_ = {assets.scene(options.mesh.value_or(options.cooked_folder / "cd.glb"))};
        material_ = {assets.material(options.material.value_or(options.cooked_folder / "cd.material"))};
        show_grating_mesh();
        show_grating_material();
    }
    if (!own_view_) add_surroundings(options, assets);
    failures_.clear();
    refresh();
    set_sun(options.sun);
    advance_to(0.0);
}

void DemoScene::add_surroundings(const Options& options, Assets& assets) {
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

void DemoScene::refresh() {
    failures_.clear();
    refresh(scene_, [this] { show_scene(); });
    refresh(grating_mesh_, [this] { show_grating_mesh(); });
    refresh(material_, [this] { show_grating_material(); });
    refresh(sphere_mesh_, [this] { show_spheres(); });
    refresh(ground_mesh_,
            [this] { world_.add(ground_, render::make_mesh_instance(scene::merge_instances(*ground_mesh_.handle))); });
}

void DemoScene::show_scene() {
    scene_.version = scene_.handle.version();
    const scene::ImportedScene& imported = *scene_.handle;
    render::SceneInstance instance = render::instantiate(world_, imported, renderer_, scene_file_);
    if (instance_) render::destroy(world_, *instance_);
    instance_ = std::move(instance);
    find_spinning();
    if (!own_view_) fit_scene(scene::merge_instances(imported));
}

void DemoScene::fit_scene(const scene::Mesh& merged) {
    // The whole scene is fitted by the entity that turns it; its size is that of the scene at rest.
    scene::Transform fit = fitting(scene::bounds(merged), kOwnMeshSize);
    fit.translation.y += kLift;
    world_.get<scene::Transform>(stand_) = {};
    for (const ecs::Entity node : instance_->nodes)
        if (world_.find<scene::Parent>(node) == nullptr) world_.add(node, scene::Parent{grating_});
    world_.get<scene::Transform>(grating_) = fit;
}

void DemoScene::find_spinning() {
    spinning_.clear();
    for (const ecs::Entity node : instance_->nodes)
        if (const auto axis = spin_axis(world_.get<scene::NodeLabel>(node).extras))
            spinning_.push_back({node, *axis, world_.get<scene::Transform>(node).rotation});
}

void DemoScene::show_grating_mesh() {
    grating_mesh_.version = grating_mesh_.handle.version();
    scene::Mesh mesh = scene::merge_instances(*grating_mesh_.handle);
    if (!disc_) fit_to_box(mesh, kOwnMeshSize);
    world_.add(grating_, render::make_mesh_instance(std::move(mesh)));
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
}

void DemoScene::set_sun(bool on) {
    if (on == sun()) return;
    if (!on) {
        world_.destroy(sun_);
        return;
    }
    sun_ = world_.create();
    world_.add(sun_, scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.55F, 0.8F, 0.35F)),
                                             .irradiance = glm::vec3(2.5F, 2.4F, 2.2F),
                                             .casts_shadow = true});
}

void DemoScene::advance_to(double seconds) {
    // The CD leans back and rocks, so that its colours wander; what is the user's turns like on a plate.
    const double lean = 52.0 + 12.0 * std::sin(0.7 * seconds);
    world_.get<scene::Transform>(stand_).rotation =
        disc_ ? about({1.0F, 0.0F, 0.0F}, lean) : about({0.0F, 1.0F, 0.0F}, 25.0 * seconds);
    if (disc_) world_.get<scene::Transform>(grating_).rotation = about({0.0F, 1.0F, 0.0F}, 40.0 * seconds);
    if (instance_ && !instance_->animations.empty()) {
        const float duration = instance_->animations[0].duration_s;
        const double time = duration > 0.0F ? std::fmod(seconds, static_cast<double>(duration)) : 0.0;
        instance_->animate(world_, 0, static_cast<float>(time));
    }
    for (const Spinning& spinning : spinning_)
        world_.get<scene::Transform>(spinning.node).rotation =
            spinning.rest * about(spinning.axis, std::fmod(kSpinDegreesPerSecond * seconds, 360.0));
    scene::update_world_matrices(world_);
}

}  // namespace rowland::demo

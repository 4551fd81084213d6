#include "content/demo/demo_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "content/demo/camera_path.h"
#include "content/demo/play/body.h"
#include "engine/core/error.h"
#include "engine/core/log.h"
#include "engine/render/gpu_mesh.h"
#include "engine/render/material.h"
#include "engine/render/scene_lights.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/gltf_extension.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/diffraction/runtime/glare_pattern.h"

namespace rowland::demo {

namespace {

constexpr float kSphereRadius = 0.025F;
constexpr float kDiscHeight = 0.052F;
constexpr float kOwnMeshSize = 0.12F;
constexpr double kDiscSpin = 40.0 / 180.0 * std::numbers::pi;
constexpr float kLift = 5e-4F;  ///< metres; keeps a flat scene out of the ground's plane

glm::quat about(const glm::vec3& axis, double degrees) {
    return glm::angleAxis(static_cast<float>(degrees * std::numbers::pi / 180.0), axis);
}

/// Scales and moves what fills `box` to stand on the origin within a cube of the given size.
scene::Transform fitting(const scene::Bounds& box, float size_m) {
    const glm::vec3 extent = box.maximum - box.minimum;
    const float largest = std::max({extent.x, extent.y, extent.z});
    const float scale = largest > 0.0F ? size_m / largest : 1.0F;
    const glm::vec3 foot((box.minimum.x + box.maximum.x) * 0.5F, box.minimum.y, (box.minimum.z + box.maximum.z) * 0.5F);
    return {.translation = -scale * foot, .rotation = {1.0F, 0.0F, 0.0F, 0.0F}, .scale = glm::vec3(scale)};
}

scene::Bounds bounds_of(ecs::World& world, const std::vector<PickTarget>& targets) {
    std::vector<scene::Bounds> boxes;
    for (const PickTarget& target : targets)
        boxes.push_back(render::transformed(target.bounds, object_to_world(world, target.entity)));
    return render::united(boxes).value_or(scene::Bounds{});
}

void fit_to_box(scene::Mesh& mesh, float size_m) {
    const scene::Transform fit = fitting(scene::bounds(mesh), size_m);
    for (glm::vec3& position : mesh.positions) position = fit.scale * position + fit.translation;
}

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

/// The body of all mesh entities below `node`. Their present pose becomes its rest pose. It has no name and no axis,
/// and cannot be grabbed yet.
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

/// The nodes that a scene's extras make toys: `"grab": true`, and `"spin_axis": [x, y, z]`, about which a node turns 20
/// degrees per second. Other values under those keys are ignored.
std::vector<Body> bodies_of(ecs::World& world, const render::SceneInstance& instance) {
    std::vector<Body> bodies;
    for (const ecs::Entity node : instance.nodes) {
        const auto& label = world.get<scene::NodeMetadata>(node);
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

/// Adds every mesh as a target, with the body that may be grabbed there.
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

}  // namespace

DemoScene::DemoScene(const Options& options, LiveAssets& assets, render::Renderer& renderer,
                     const glm::dmat3& xyz_to_working)
    : renderer_(renderer), xyz_to_working_(xyz_to_working), disc_(!options.mesh && !options.scene) {
    camera_.eye = {0.0F, 0.14F, 0.38F};
    camera_.target = {0.0F, 0.047F, 0.0F};
    camera_.vertical_field_of_view = kFieldOfView;

    root_ = world_.create();
    world_.add(root_, scene::Transform{});
    stand_ = add_under(root_, {0.0F, disc_ ? kDiscHeight : 0.0F, 0.0F});
    grating_ = add_under(stand_);
    if (options.scene) {
        scene_ = assets.scene(*options.scene);
        own_view_ = !scene_->cameras.empty();
        if (own_view_) camera_ = views().front();
        add_part(scene_, [this, file = options.scene->string()](const auto& scene) { show_scene(scene, file); });
    } else {
        add_part(assets.mesh(options.mesh.value_or(options.cooked_folder / "cd.glb")),
                 [this](const auto& mesh) { show_grating_mesh(mesh); });
        add_part(assets.load<diffraction::CookedMaterial>(
                     options.material.value_or(options.cooked_folder / "cd.material"), diffraction::kMaterialAssetType,
                     diffraction::read_cooked_material),
                 [this](const auto& material) { show_grating_material(material); });
    }
    if (!own_view_) add_surroundings(options, assets);
    set_sun(options.sun);
    if (options.camera) {
        const auto& at = *options.camera;
        camera_.eye = {at[0], at[1], at[2]};
        camera_.target = {at[3], at[4], at[5]};
    }
    if (options.frame_object) frame_object(*options.frame_object);
    chosen_view_ = options.camera || options.frame_object;
}

/// Keeps the view's direction.
void DemoScene::frame_object(const std::string& name) {
    scene::update_world_matrices(world_);
    std::vector<scene::Bounds> boxes;
    std::set<std::string> names;
    world_.view<render::MeshInstance>().each([&](ecs::Entity entity, const render::MeshInstance& instance) {
        const std::string object = name_of_object(world_, entity);
        names.insert(object);
        if (object == name)
            boxes.push_back(render::transformed(instance.gpu->bounds(), world_.get<scene::WorldMatrix>(entity).matrix));
    });
    const auto box = render::united(boxes);
    if (!box)
        refuse_input("--frame-object", "", name, fmt::format("the name of an object: {}", fmt::join(names, ", ")));
    camera_ =
        scene::framed(camera_, 0.5F * (box->minimum + box->maximum), 0.5F * glm::length(box->maximum - box->minimum));
}

template <typename T, typename Show>
void DemoScene::add_part(const asset::Handle<T>& handle, Show show) {
    parts_.push_back({.version = [handle] { return handle.version(); },
                      .show = [handle, show] { show(*handle); },
                      .shown = handle.version()});
    show(*handle);
}

ecs::Entity DemoScene::add_under(ecs::Entity parent, const glm::vec3& position) {
    const ecs::Entity entity = world_.create();
    world_.add(entity, scene::Transform{.translation = position});
    world_.add(entity, scene::Parent{parent});
    return entity;
}

void DemoScene::add_surroundings(const Options& options, LiveAssets& assets) {
    const ecs::Entity diffuse = add_under(root_, {-0.092F, 0.0F, 0.02F});
    world_.add(diffuse, render::StandardMaterial{.base_colour = glm::vec3(0.75F), .metallic = 0.0F, .roughness = 1.0F});
    const ecs::Entity metal = add_under(root_, {0.092F, 0.0F, 0.02F});
    world_.add(metal, render::StandardMaterial{
                          .base_colour = glm::vec3(0.95F, 0.93F, 0.88F), .metallic = 1.0F, .roughness = 0.12F});
    const ecs::Entity ground = add_under(root_);
    world_.add(ground, render::StandardMaterial{.base_colour = glm::vec3(0.18F), .metallic = 0.0F, .roughness = 0.6F});
    add_part(assets.mesh(options.cooked_folder / "sphere.glb"), [this, diffuse, metal](scene::Mesh sphere) {
        fit_to_box(sphere, 2.0F * kSphereRadius);
        const render::MeshInstance instance = render::make_mesh_instance(std::move(sphere));
        world_.add(diffuse, instance);
        world_.add(metal, instance);
        meshes_changed_ = true;
    });
    add_part(assets.mesh(options.cooked_folder / "ground.glb"), [this, ground](const scene::Mesh& mesh) {
        world_.add(ground, render::make_mesh_instance(scene::Mesh(mesh)));
        meshes_changed_ = true;
    });
}

bool DemoScene::refresh() {
    failures_.clear();
    meshes_changed_ = false;
    for (Part& part : parts_) {
        if (part.shown == part.version()) continue;
        part.shown = part.version();
        try {
            part.show();
        } catch (const Error& error) {
            log_error("{}", error.what());
            failures_.emplace_back(error.what());
        }
    }
    return meshes_changed_;
}

void DemoScene::show_scene(const scene::ImportedScene& imported, const std::string& file) {
    render::SceneInstance instance = render::instantiate(world_, imported, renderer_, file);
    if (instance_) render::destroy(world_, *instance_);
    instance_ = std::move(instance);
    meshes_changed_ = true;
    for (const ecs::Entity node : instance_->nodes)
        if (world_.find<scene::Parent>(node) == nullptr) world_.add(node, scene::Parent{own_view_ ? root_ : grating_});
    if (own_view_) return;
    // grating_ also scales the scene to the CD's size, measured at rest.
    scene::Transform fit = fitting(scene::bounds(scene::merge_instances(imported)), kOwnMeshSize);
    fit.translation.y += kLift;
    world_.get<scene::Transform>(grating_) = fit;
}

void DemoScene::show_grating_mesh(scene::Mesh mesh) {
    if (!disc_) fit_to_box(mesh, kOwnMeshSize);
    world_.add(grating_, render::make_mesh_instance(std::move(mesh)));
    meshes_changed_ = true;
}

void DemoScene::show_grating_material(const diffraction::CookedMaterial& cooked) {
    auto material = diffraction::make_gpu_material(cooked, xyz_to_working_);
    world_.add(grating_, material->base());
    world_.add(grating_, diffraction::DiffractionSurface{std::move(material)});
}

void DemoScene::show_floor(bool shown) {
    if (!instance_) return;
    if (shown) {
        for (auto& [entity, mesh] : hidden_floor_)
            if (world_.alive(entity)) world_.add(entity, std::move(mesh));
        hidden_floor_.clear();
        return;
    }
    for (const ecs::Entity entity : instance_->drawn) {
        const auto* parent = world_.find<scene::Parent>(entity);
        const auto* label = parent != nullptr ? world_.find<scene::NodeMetadata>(parent->entity) : nullptr;
        const auto* mesh = world_.find<render::MeshInstance>(entity);
        if (label == nullptr || mesh == nullptr || !scene::is_marked(label->extras, "floor")) continue;
        hidden_floor_.emplace_back(entity, *mesh);
        world_.remove<render::MeshInstance>(entity);
    }
}

void DemoScene::set_sun(bool on) {
    if (on == sun()) return;
    if (!on) {
        world_.destroy(sun_);
        return;
    }
    sun_ = add_under(root_);
    world_.add(sun_, scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.55F, 0.8F, 0.35F)),
                                             .irradiance = glm::vec3(2.5F, 2.4F, 2.2F),
                                             .angular_radius = scene::kSunAngularRadius,
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
    // The CD leans back and rocks, so that its colours move; the user's mesh or scene turns about the vertical.
    const double lean = 52.0 + 12.0 * std::sin(0.7 * stand_s_);
    world_.get<scene::Transform>(stand_).rotation =
        disc_ ? about({1.0F, 0.0F, 0.0F}, lean) : about({0.0F, 1.0F, 0.0F}, 25.0 * stand_s_);
}

void DemoScene::pose(const Play& play) {
    const double elapsed = play.time_s() - posed_s_;
    posed_s_ = play.time_s();
    // The stand stops once the grating has been grabbed, which must not turn under the hand.
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

const nlohmann::json* DemoScene::sheet() const {
    if (!own_view_) return nullptr;
    const nlohmann::json& extras = scene_->nodes[scene_->cameras.front().node].extras;
    return extras.is_object() && extras.contains("glare") ? &extras["glare"] : nullptr;
}

std::vector<scene::Camera> DemoScene::views() const {
    if (!own_view_ || chosen_view_) return {camera_};
    return all_views(*scene_, scene::merge_instances(*scene_));
}

namespace {

diffraction::GltfGrating grating_of(const Sheet& sheet, const DemoScene& scene) {
    if (!sheet.file.empty())
        return diffraction::parse_gltf_extension(diffraction::load_material_json(sheet.file), sheet.file.string(),
                                                 sheet.file.parent_path());
    const nlohmann::json* json = scene.sheet();
    return diffraction::parse_gltf_extension(json != nullptr ? *json : nlohmann::json(), sheet.name,
                                             std::filesystem::path(), "/extras/glare");
}

}  // namespace

std::vector<Sheet> sheets(const Options& options, const DemoScene& scene) {
    if (options.glare) return {{options.glare->stem().string(), *options.glare}};
    std::vector<Sheet> all;
    if (scene.sheet() != nullptr) all.push_back({options.scene->filename().string() + "'s camera", {}});
    for (const char* name : {"diffraction_glasses", "feather", "screen_door", "camera_under_display"})
        if (const auto file = options.content_folder / "materials" / (std::string(name) + ".json");
            std::filesystem::exists(file))
            all.push_back({name, file});
    return all;
}

post::GlareSettings glare_of(const Sheet& sheet, const DemoScene& scene, const glm::dmat3& xyz_to_working) {
    const diffraction::GltfGrating grating = grating_of(sheet, scene);
    const diffraction::Material solved = diffraction::with_efficiencies(grating.material, sheet.name);
    return {.pattern = std::make_shared<post::GlarePattern>(diffraction::glare_pattern(solved.grating, xyz_to_working)),
            .angle = static_cast<float>(grating.groove_rotation)};
}

}  // namespace rowland::demo

#include "editor/inspector/preview.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <utility>

#include "editor/inspector/pick_point.h"
#include "engine/core/check.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/transform.h"
#include "modules/material_types.h"
#include "modules/diffraction/runtime/diffraction_surface.h"

namespace rowland::inspector {

namespace {

constexpr glm::vec3 kUp(0.0F, 1.0F, 0.0F);
constexpr glm::vec3 kPlace(0.0F, 0.052F, 0.0F);  ///< of the object, metres

/// How far each shape leans back, so that it shows its colours.
float lean_deg(PreviewShape shape) {
    if (shape == PreviewShape::Disc) return 52.0F;
    return shape == PreviewShape::Card || shape == PreviewShape::Sheet ? -28.0F : 0.0F;
}

glm::mat4 placed(PreviewShape shape) {
    return glm::rotate(glm::translate(glm::mat4(1.0F), kPlace), glm::radians(lean_deg(shape)), {1.0F, 0.0F, 0.0F});
}

glm::vec3 lamp_direction(const Stage& stage) {
    const float azimuth = glm::radians(stage.lamp_azimuth_deg);
    const float elevation = glm::radians(stage.lamp_elevation_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

scene::Camera turned(scene::Camera camera, const glm::mat4& turn) {
    camera.eye = glm::vec3(turn * glm::vec4(camera.eye, 1.0F));
    camera.target = glm::vec3(turn * glm::vec4(camera.target, 1.0F));
    return camera;
}

}  // namespace

scene::Camera opening_camera() {
    scene::Camera camera;
    camera.eye = {0.0F, 0.14F, 0.38F};
    camera.target = {0.0F, 0.047F, 0.0F};
    camera.vertical_field_of_view = 0.36F;
    return camera;
}

Preview::Side::Side(const post::OcioConfig& config, bool still) : picture(config, {}, {1, 1}) {
    diffraction::DiffractionSettings settings;
    if (still) settings.slices_per_frame = std::numeric_limits<int>::max();
    modules::register_material_types(picture.renderer(), {.diffraction = settings});
    object = world.create();
    world.add(object, scene::Transform{});
}

void Preview::Side::show(const diffraction::CookedMaterial& cooked) {
    auto material = diffraction::make_gpu_material(cooked, picture.xyz_to_working());
    render::StandardMaterial base = material->base();
    base.double_sided = true;
    world.add(object, base);
    world.add(object, diffraction::DiffractionSurface{std::move(material)});
}

void Preview::Side::place(const glm::mat4& object_to_world, const Stage& stage, const glm::mat4& turn) {
    world.get<scene::Transform>(object) = {.translation = glm::vec3(object_to_world[3]),
                                           .rotation = glm::quat_cast(glm::mat3(object_to_world))};
    if (stage.lamp) {
        if (!world.alive(lamp)) lamp = world.create();
        world.add(lamp, scene::DirectionalLight{.direction = glm::normalize(glm::mat3(turn) * lamp_direction(stage)),
                                                .irradiance = glm::vec3(stage.lamp_irradiance),
                                                .casts_shadow = false});
    } else if (world.alive(lamp)) {
        world.destroy(lamp);
    }
    scene::update_world_matrices(world);
    picture.post_settings().exposure_stops = stage.exposure_stops;
}

Preview::Preview(const post::OcioConfig& config, bool still)
    : config_(config), still_(still), now_(std::make_unique<Side>(config, still)) {
    set_shape(PreviewShape::Disc, std::nullopt);
}

Preview::Side& Preview::saved_side() {
    if (saved_) return *saved_;
    saved_ = std::make_unique<Side>(config_, still_);
    saved_->world.add(saved_->object, mesh_);
    if (light_) saved_->picture.set_probe(light_->probe);
    if (saved_material_) saved_->show(*saved_material_);
    return *saved_;
}

void Preview::set_shape(PreviewShape shape, const std::optional<scene::Mesh>& model) {
    ROWLAND_CHECK(shape != PreviewShape::Model || model, "a model is shown once there is one");
    shape_ = shape;
    mesh_ = render::make_mesh_instance(shape == PreviewShape::Model ? *model : preview_mesh(shape));
    now_->world.add(now_->object, mesh_);
    if (saved_) saved_->world.add(saved_->object, mesh_);
}

void Preview::set_light(std::shared_ptr<const InspectedLight> light) {
    light_ = std::move(light);
    now_->picture.set_probe(light_->probe);
    if (saved_) saved_->picture.set_probe(light_->probe);
}

void Preview::set_material(std::shared_ptr<const diffraction::CookedMaterial> cooked) {
    material_ = std::move(cooked);
    now_->show(*material_);
}

void Preview::set_saved(std::shared_ptr<const diffraction::CookedMaterial> cooked) {
    saved_material_ = std::move(cooked);
    if (saved_ && saved_material_) saved_->show(*saved_material_);
}

void Preview::draw(glm::ivec2 size, const scene::Camera& camera, const Stage& stage, bool with_saved, float seconds) {
    ROWLAND_CHECK(ready(), "a preview is drawn once it has light and a material");
    // The probe stays where it is; all else turns the other way, which is the same picture.
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0F), -glm::radians(stage.rotation_deg), kUp);
    camera_ = turned(camera, turn);
    object_to_world_ = turn * placed(shape_);
    aspect_ = static_cast<float>(size.x) / static_cast<float>(size.y);
    const auto draw_side = [&](Side& side) {
        side.place(object_to_world_, stage, turn);
        side.picture.resize(size);
        side.picture.draw(side.world, camera_, seconds);
    };
    draw_side(*now_);
    if (with_saved && saved_material_) draw_side(saved_side());
}

std::optional<diffraction::Frame> Preview::pick(const glm::vec2& at) const {
    return pick_point(*mesh_.mesh, object_to_world_, ray_through(camera_, aspect_, at));
}

}  // namespace rowland::inspector

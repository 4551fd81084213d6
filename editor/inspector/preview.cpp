#include "editor/inspector/preview.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "editor/inspector/pick_point.h"
#include "engine/core/check.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/material_types.h"

namespace rowland::inspector {

namespace {

constexpr glm::vec3 kUp(0.0F, 1.0F, 0.0F);
constexpr glm::vec3 kPosition(0.0F, 0.052F, 0.0F);  ///< of the object, metres

/// How far each shape leans back, so that it shows its colours.
float lean_deg(PreviewShape shape) {
    if (shape == PreviewShape::Disc) return 52.0F;
    return shape == PreviewShape::Card || shape == PreviewShape::Sheet ? -28.0F : 0.0F;
}

constexpr int kFramesToFill = 90;  ///< upper bound of the frames that maps take to fill

/// The probe's axes are kept; everything else turns the other way, which gives the same picture.
glm::mat4 turn_of(const Stage& stage) {
    return glm::rotate(glm::mat4(1.0F), -glm::radians(stage.rotation_deg), kUp);
}

glm::mat4 object_to_world(const PreviewInputs& inputs) {
    return glm::rotate(glm::translate(turn_of(inputs.stage), kPosition), glm::radians(lean_deg(inputs.object->shape)),
                       {1.0F, 0.0F, 0.0F});
}

scene::Camera turned_camera(const PreviewInputs& inputs) {
    const glm::mat4 turn = turn_of(inputs.stage);
    scene::Camera camera = opening_camera();
    camera.eye = glm::vec3(turn * glm::vec4(inputs.eye, 1.0F));
    camera.target = glm::vec3(turn * glm::vec4(inputs.target, 1.0F));
    return camera;
}

}  // namespace

glm::vec3 lamp_direction(const Stage& stage) {
    const float azimuth = glm::radians(stage.lamp_azimuth_deg);
    const float elevation = glm::radians(stage.lamp_elevation_deg);
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation), std::cos(elevation) * std::cos(azimuth)};
}

scene::Camera opening_camera() {
    scene::Camera camera;
    camera.eye = {0.0F, 0.14F, 0.38F};
    camera.target = {0.0F, 0.047F, 0.0F};
    camera.vertical_field_of_view = 0.36F;
    return camera;
}

Preview::Side::Side(const post::OcioConfig& config, bool still) : picture(config, {}, {1, 1}) {
    diffraction::DiffractionSettings settings;
    if (still) settings.map_pace = diffraction::MapPace::Whole;
    modules::register_material_types(picture.renderer(), {.diffraction = settings});
    entity = world.create();
    world.add(entity, scene::Transform{});
}

void Preview::Side::show(const PreviewInputs& inputs,
                         const std::shared_ptr<const diffraction::CookedMaterial>& cooked) {
    if (std::exchange(object, inputs.object) != inputs.object) world.add(entity, object->mesh);
    if (std::exchange(light, inputs.light) != inputs.light) picture.set_probe(light->probe);
    if (std::exchange(material, cooked) != cooked) {
        auto uploaded = diffraction::make_gpu_material(*cooked, picture.xyz_to_working());
        render::StandardMaterial base = uploaded->base();
        base.double_sided = true;
        world.add(entity, base);
        world.add(entity, diffraction::DiffractionSurface{std::move(uploaded)});
    }
}

void Preview::Side::draw(const PreviewInputs& inputs, float seconds) {
    const glm::mat4 to_world = object_to_world(inputs);
    const Stage& stage = inputs.stage;
    world.get<scene::Transform>(entity) = {.translation = glm::vec3(to_world[3]),
                                           .rotation = glm::quat_cast(glm::mat3(to_world))};
    if (stage.lamp) {
        if (!world.alive(lamp)) lamp = world.create();
        world.add(lamp, scene::DirectionalLight{
                            .direction = glm::normalize(glm::mat3(turn_of(stage)) * lamp_direction(stage)),
                            .irradiance = glm::vec3(stage.lamp_irradiance),
                            .casts_shadow = false});
    } else if (world.alive(lamp)) {
        world.destroy(lamp);
    }
    scene::update_world_matrices(world);
    picture.post_settings().exposure_stops = stage.exposure_stops;
    picture.resize(inputs.size);
    picture.draw(world, turned_camera(inputs), seconds);
}

void Preview::show(const PreviewInputs& inputs) {
    ROWLAND_CHECK(inputs.object && inputs.light && inputs.material, "a preview needs an object, light and a material");
    if (inputs == inputs_) return;
    inputs_ = inputs;
    unchanged_ = 0;
    if (inputs.saved && !saved_) saved_.emplace(config_, still_);
    now_.show(inputs, inputs.material);
    if (inputs.saved) saved_->show(inputs, inputs.saved);
}

bool Preview::changes() const {
    return drawn_ && unchanged_ <= kFramesToFill;
}

void Preview::draw(float seconds) {
    if (unchanged_ > kFramesToFill) return;
    ++unchanged_;
    drawn_ = true;
    now_.draw(inputs_, seconds);
    if (inputs_.saved) saved_->draw(inputs_, seconds);
    // Maps begin to fill in the second frame in which nothing moves.
    constexpr int kFramesToBegin = 3;
    const bool filling =
        diffraction::maps_are_filling(now_.world) || (inputs_.saved && diffraction::maps_are_filling(saved_->world));
    if (unchanged_ >= kFramesToBegin && !filling) unchanged_ = kFramesToFill + 1;
}

std::optional<diffraction::ShadingPoint> Preview::pick(const glm::vec2& at) const {
    if (!drawn_) return std::nullopt;
    const float aspect = static_cast<float>(inputs_.size.x) / static_cast<float>(inputs_.size.y);
    return pick_point(*inputs_.object->mesh.mesh, object_to_world(inputs_),
                      ray_through(turned_camera(inputs_), aspect, at));
}

}  // namespace rowland::inspector

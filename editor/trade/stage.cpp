#include "editor/trade/stage.h"

#include <epoxy/gl.h>

#include <chrono>
#include <limits>
#include <utility>

#include "editor/trade/picture_scene.h"
#include "engine/gpu/lost_context.h"
#include "engine/post/shader_files.h"
#include "engine/post/working_space.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/directional_light.h"
#include "engine/scene/transform.h"
#include "modules/material_types.h"

namespace rowland::trade {

namespace {

using Clock = std::chrono::steady_clock;

constexpr float kSecondsPerFrame = 1.0F / 30.0F;

gpu::ShaderLibrary post_shaders() {
    gpu::ShaderLibrary library;
    library.add_embedded(post::shader_files());
    return library;
}

post::PostSettings all_effects(const scene::Camera& camera) {
    return {.bloom = post::BloomSettings{},
            .auto_exposure = post::AutoExposureSettings{},
            .vignette = post::VignetteSettings{.vertical_fov = camera.vertical_field_of_view, .strength = 0.3F},
            .dither = post::DitherSettings{}};
}

double milliseconds_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

Stage::Stage(glm::ivec2 size, const scene::Camera& camera)
    : camera_(camera),
      config_(post::OcioConfig::shipped()),
      xyz_to_working_(post::xyz_to_scene_linear(config_)),
      renderer_(xyz_to_working_),
      target_({.width = size.x, .height = size.y, .depth = true}),
      encoded_({.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}}),
      post_shaders_(post_shaders()),
      display_(post_shaders_, post::DisplayTransform(config_)),
      post_stack_(post_shaders_) {
    modules::register_material_types(renderer_, {.diffraction = {.slices_per_frame = std::numeric_limits<int>::max()}});
    renderer_.add_material_type(std::make_unique<LightLoopType>());
    disc_ = add_surface(disc_mesh(), glm::vec3(0.0F));
    vertices_ = world_.get<render::MeshInstance>(disc_).mesh->positions.size();
    show_sphere(true);
    set_directional_light(true);
}

ecs::Entity Stage::add_surface(scene::Mesh mesh, const glm::vec3& place) {
    const ecs::Entity entity = world_.create();
    world_.add(entity, scene::Transform{.translation = place});
    world_.add(entity, render::make_mesh_instance(std::move(mesh)));
    world_.add(entity, render::StandardMaterial{.base_colour = glm::vec3(0.02F), .roughness = 0.3F});
    scene::update_world_matrices(world_);
    return entity;
}

void Stage::set_probe(const lighting::LightProbe& probe) {
    key_lights_ = !probe.key_lights.empty();
    renderer_.set_probe(probe);
}

void Stage::set_directional_light(bool on) {
    if (on == light_.has_value()) return;
    if (on) {
        light_ = world_.create();
        world_.add(*light_, scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 1.0F, 0.4F)),
                                                    .irradiance = glm::vec3(0.5F)});
    } else {
        world_.destroy(*light_);
        light_.reset();
    }
}

void Stage::show_sphere(bool show) {
    if (show == sphere_.has_value()) return;
    if (show) {
        sphere_ = add_surface(sphere_mesh(), kSphereCentre);
    } else {
        world_.destroy(*sphere_);
        sphere_.reset();
    }
}

void Stage::clear_materials() {
    for (const std::optional<ecs::Entity> entity : {std::optional(disc_), sphere_}) {
        if (!entity) continue;
        if (world_.find<diffraction::DiffractionSurface>(*entity) != nullptr)
            world_.remove<diffraction::DiffractionSurface>(*entity);
        if (world_.find<LightLoopSurface>(*entity) != nullptr) world_.remove<LightLoopSurface>(*entity);
    }
}

void Stage::show_plain() {
    clear_materials();
    renderer_.use_key_lights(false);
}

std::shared_ptr<const diffraction::GpuMaterial> Stage::upload(const diffraction::CookedMaterial& material) const {
    return diffraction::make_gpu_material(material, xyz_to_working_);
}

void Stage::show_grating(std::shared_ptr<const diffraction::GpuMaterial> material) {
    clear_materials();
    renderer_.use_key_lights(key_lights_);
    world_.add(disc_, diffraction::DiffractionSurface{material});
    if (sphere_) world_.add(*sphere_, diffraction::DiffractionSurface{std::move(material)});
}

void Stage::show_light_loop(std::shared_ptr<const LightLoop> loop) {
    clear_materials();
    renderer_.use_key_lights(false);
    world_.add(disc_, LightLoopSurface{loop});
    if (sphere_) world_.add(*sphere_, LightLoopSurface{std::move(loop)});
}

void Stage::render() {
    renderer_.render(world_, camera_, target_);
}

double Stage::draw() {
    const Clock::time_point start = Clock::now();
    render();
    glFinish();
    gpu::require_context();
    return milliseconds_since(start);
}

double Stage::draw_with_effects() {
    const Clock::time_point start = Clock::now();
    render();
    post_stack_.draw(
        target_.colour(), display_, all_effects(camera_),
        {.index = frame_++, .seconds = kSecondsPerFrame, .luminance_weights = post::luminance_weights(config_)},
        encoded_);
    glFinish();
    gpu::require_context();
    return milliseconds_since(start);
}

std::vector<std::uint8_t> Stage::picture(float exposure_stops) {
    render();
    render();  // maps of objects that have just come to rest
    post_stack_.draw(target_.colour(), display_, {.exposure_stops = exposure_stops}, {.index = frame_++}, encoded_);
    const std::vector<std::uint8_t> rgba = encoded_.read_rgba8();
    gpu::require_context();
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    return rgb;
}

}  // namespace rowland::trade

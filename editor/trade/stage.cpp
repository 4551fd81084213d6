#include "editor/trade/stage.h"

#include <epoxy/gl.h>

#include <chrono>
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

}  // namespace

Stage::Stage(glm::ivec2 size, const scene::Camera& camera, bool directional_light)
    : camera_(camera),
      config_(post::OcioConfig::shipped()),
      xyz_to_working_(post::xyz_to_scene_linear(config_)),
      renderer_(xyz_to_working_),
      target_({.width = size.x, .height = size.y, .depth = true}),
      encoded_({.width = size.x, .height = size.y, .colours = {gpu::Format::RGBA8}}),
      post_shaders_(post_shaders()),
      display_(post_shaders_, post::DisplayTransform(config_)),
      post_stack_(post_shaders_),
      disc_(world_.create()) {
    modules::register_material_types(renderer_, {.diffraction = {.map_pace = diffraction::MapPace::Whole}});
    renderer_.add_material_type(std::make_unique<LightLoopType>());
    world_.add(disc_, scene::Transform{});
    world_.add(disc_, render::make_mesh_instance(disc_mesh()));
    world_.add(disc_, render::StandardMaterial{.base_colour = glm::vec3(0.02F), .roughness = 0.3F});
    scene::update_world_matrices(world_);
    if (directional_light)
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 1.0F, 0.4F)),
                                                            .irradiance = glm::vec3(0.5F)});
}

std::size_t Stage::vertices() const {
    return disc_mesh().positions.size();
}

void Stage::set_probe(const lighting::LightProbe& probe) {
    has_key_lights_ = !probe.key_lights.empty();
    renderer_.set_probe(probe);
}

void Stage::clear_surface(bool use_key_lights) {
    if (world_.find<diffraction::DiffractionSurface>(disc_) != nullptr)
        world_.remove<diffraction::DiffractionSurface>(disc_);
    if (world_.find<LightLoopSurface>(disc_) != nullptr) world_.remove<LightLoopSurface>(disc_);
    renderer_.use_key_lights(use_key_lights);
}

void Stage::show_plain() {
    clear_surface(false);
}

std::shared_ptr<const diffraction::GpuMaterial> Stage::upload(const diffraction::CookedMaterial& material) const {
    return diffraction::make_gpu_material(material, xyz_to_working_);
}

void Stage::show_grating(std::shared_ptr<const diffraction::GpuMaterial> material) {
    clear_surface(has_key_lights_);
    world_.add(disc_, diffraction::DiffractionSurface{std::move(material)});
}

void Stage::show_light_loop(std::shared_ptr<const LightLoop> loop) {
    clear_surface(false);
    world_.add(disc_, LightLoopSurface{std::move(loop)});
}

void Stage::draw_effects(const post::PostSettings& settings) {
    post_stack_.draw(
        target_.colour(), display_, settings,
        {.index = frame_++, .seconds = kSecondsPerFrame, .luminance_weights = post::luminance_weights(config_)},
        encoded_);
}

double Stage::draw(bool effects) {
    const Clock::time_point start = Clock::now();
    render();
    if (effects) draw_effects(all_effects(camera_));
    glFinish();
    gpu::require_context();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::vector<std::uint8_t> Stage::picture(float exposure_stops) {
    render();
    render();  // fills the maps of an object that has just come to rest
    draw_effects({.exposure_stops = exposure_stops});
    const std::vector<std::uint8_t> rgba = encoded_.read_rgba8();
    gpu::require_context();
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    return rgb;
}

}  // namespace rowland::trade

#include "editor/trade/stage.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <glm/vec4.hpp>
#include <iterator>
#include <string>
#include <utility>

#include "editor/trade/inputs.h"
#include "engine/colour/spectrum.h"
#include "engine/core/error.h"
#include "engine/core/text.h"
#include "engine/gpu/context.h"
#include "engine/post/ocio_config.h"
#include "engine/post/post_stack.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/light.h"
#include "engine/scene/transform.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/shaders/shader_files.h"
#include "modules/material_types.h"

namespace rowland::trade {

/// light_loop.frag.glsl.
std::span<const EmbeddedFile> light_loop_files();

namespace {

constexpr unsigned kLightBinding = 4;
constexpr unsigned kColourUnit = 8;
constexpr int kWavelengths = colour::kVisibleMax - colour::kVisibleMin + 1;
constexpr std::size_t kMostOrders = 64;  ///< as in light_loop.frag.glsl

std::vector<float> orders_other_than_0(const diffraction::Grating& grating) {
    std::vector<float> orders;
    for (const int order : grating.orders)
        if (order != 0) orders.push_back(static_cast<float>(order));
    return orders;
}

/// ½ d/|m| η_m cmf E: the XYZ that a light adds whose irradiance on the surface is 1 (PHYSICS §4).
gpu::Texture colour_rows(const diffraction::Grating& grating, std::span<const float> orders,
                         const colour::LightSpectra& spectra) {
    std::vector<glm::vec4> texels;
    for (const float order : orders)
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < kWavelengths; ++i) {
                const double wavelength_nm = colour::kVisibleMin + i;
                const double weight = 0.5 * grating.pitch_nm / std::abs(order) *
                                      diffraction::order_efficiency(grating, static_cast<int>(order), wavelength_nm) *
                                      spectra(wavelength_nm)[c];
                texels.emplace_back(glm::vec3(weight * colour::cie_xyz(wavelength_nm)), 0.0F);
            }
    gpu::Texture texture({.format = gpu::Format::RGBA32F,
                          .width = kWavelengths,
                          .height = std::max(1, 3 * static_cast<int>(orders.size()))});
    if (!texels.empty()) texture.upload(std::span<const glm::vec4>(texels));
    return texture;
}

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

constexpr int kRounds = 3;
constexpr int kFramesPerRound = 2;
constexpr double kSlow_ms = 250.0;  ///< longer frames are timed once
constexpr int kWarmUpFrames = 2;    ///< not timed: they link programs, divide the light and fill maps

/// Key lights are fitted when a setting asks for them.
lighting::LightProbe without_key_lights(const lighting::ProbeImage& image) {
    lighting::LightProbeSettings settings;
    settings.key_lights = 0;
    return lighting::build_light_probe(image, settings);
}

}  // namespace

LightLoop::LightLoop(const diffraction::Grating& grating, const colour::LightSpectra& spectra,
                     const glm::dmat3& xyz_to_working)
    : pitch_nm_(grating.pitch_nm), orders_(orders_other_than_0(grating)) {
    if (grating.lattice || !is_flat(grating.lobe) || grating.cover || grating.transmission ||
        grating.grooves < diffraction::kManyGrooves || orders_.size() > kMostOrders)
        refuse_input("light loop", {}, "another grating",
                     "a flat groove_lobe without a cover or a transmission, sharp orders (50 grooves or more), at most "
                     "64 of them");
    const diffraction::LayerWeights weights = diffraction::layer_weights(grating);
    mirror_weight_ = glm::vec3(xyz_to_working * weights.mirror);
    base_weight_ = glm::vec3(xyz_to_working * weights.base);
    colours_ = colour_rows(grating, orders_, spectra);
    set_lights({});
}

void LightLoop::set_lights(std::span<const render::DistantLight> lights) {
    std::vector<glm::vec4> values;
    for (const render::DistantLight& light : lights) {
        values.emplace_back(light.direction, 0.0F);
        values.emplace_back(light.irradiance, 0.0F);
    }
    light_count_ = static_cast<int>(lights.size());
    if (values.empty()) values.resize(2);
    lights_ = gpu::Buffer::of(std::span<const glm::vec4>(values));
}

void LightLoop::bind(const gpu::Program& program) const {
    colours_.bind(kColourUnit);
    lights_.bind_storage(kLightBinding);
    program.set("light_count", light_count_);
    program.set("order_count", orders());
    program.set("orders", std::span<const float>(orders_));
    program.set("pitch_nm", static_cast<float>(pitch_nm_));
    program.set("groove_turn", glm::vec2(1.0F, 0.0F));
    program.set("mirror_weight", mirror_weight_);
    program.set("base_weight", base_weight_);
}

void LightLoopType::add_shaders(gpu::ShaderLibrary& library) const {
    library.add_embedded(diffraction::shader_files());
    library.add_embedded(light_loop_files());
}

bool LightLoopType::owns(ecs::World& world, ecs::Entity entity) const {
    return world.find<LightLoopSurface>(entity) != nullptr;
}

gpu::ProgramDesc LightLoopType::program(ecs::World& /*world*/, ecs::Entity /*entity*/,
                                        render::ProbeSlot /*slot*/) const {
    return {.vertex = "modules/diffraction/shaders/grating.vert.glsl", .fragment = "editor/trade/light_loop.frag.glsl"};
}

void LightLoopType::bind(ecs::World& world, ecs::Entity entity, render::ProbeSlot /*slot*/,
                         const gpu::Program& program) const {
    world.get<LightLoopSurface>(entity).loop->bind(program);
}

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
    render();  // fills the maps, which begins in the second frame without motion
    draw_effects({.exposure_stops = exposure_stops});
    const std::vector<std::uint8_t> rgba = encoded_.read_rgba8();
    gpu::require_context();
    std::vector<std::uint8_t> rgb;
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    return rgb;
}

FrameTimer::FrameTimer(const lighting::ProbeImage& probe, glm::ivec2 size)
    : context_({.debug = false}),
      image_(&probe),
      probe_(without_key_lights(probe)),
      stage_(size, close_camera(), true) {}

void FrameTimer::light_by(int key_lights) {
    if (lit_by_ == key_lights) return;
    if (!fitted_.contains(key_lights)) fitted_[key_lights] = lighting::fit_key_lights(*image_, key_lights);
    probe_.key_lights = fitted_[key_lights];
    stage_.set_probe(probe_);
    lit_by_ = key_lights;
}

template <typename Show>
std::vector<double> FrameTimer::times(Show&& show) {
    show();
    std::vector<double> ms;
    for (int i = 0; i < kWarmUpFrames; ++i) stage_.draw();
    while (ms.size() < kFramesPerRound && (ms.empty() || ms.back() <= kSlow_ms)) ms.push_back(stage_.draw());
    return ms;
}

FrameTime FrameTimer::time(const diffraction::CookedMaterial& material, int key_lights) {
    light_by(key_lights);
    const auto grating = stage_.upload(material);
    std::vector<double> plain;
    std::vector<double> ms;
    for (int round = 0; round < kRounds && (ms.empty() || std::ranges::min(ms) <= kSlow_ms); ++round) {
        std::ranges::copy(times([&] { stage_.show_plain(); }), std::back_inserter(plain));
        std::ranges::copy(times([&] { stage_.show_grating(grating); }), std::back_inserter(ms));
    }
    std::ranges::sort(ms);
    FrameTime result{.ms = ms.front(), .plain_ms = std::ranges::min(plain)};
    if (ms.size() > 1) result.spread = ms[ms.size() / 2] / ms.front() - 1.0;
    return result;
}

}  // namespace rowland::trade

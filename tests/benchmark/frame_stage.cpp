#include "tests/benchmark/frame_stage.h"

#include <ctime>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

#include "editor/trade/stage.h"
#include "engine/asset/container.h"
#include "engine/core/program.h"
#include "engine/lighting/procedural_probe.h"
#include "engine/post/ocio_config.h"
#include "engine/scene/mesh_recipe.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/thin_film/module.h"
#include "modules/thin_film/runtime/film_surface.h"
#include "tests/benchmark/cd_materials.h"
#include "tests/evidence/peers/peer_material.h"

namespace rowland::benchmark {

namespace {

constexpr double kIrradiance = 2.0;  ///< of all lamps together, on surfaces that face them
constexpr double kHalfSize_deg = 3.0;
constexpr double kLowest = 0.25;  ///< sines of elevations
constexpr double kHighest = 0.95;
constexpr int kProbeWidth = 512;

/// Directions by the golden angle: spread evenly for any count.
glm::dvec3 lamp_direction(int lamp, int count) {
    const double y = kLowest + (kHighest - kLowest) * (lamp + 0.5) / count;
    const double azimuth = lamp * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - y * y);
    return {r * std::sin(azimuth), y, -r * std::cos(azimuth)};
}

/// Lamps spread evenly over the upper part of the sky. Their sum does not depend on their number.
std::vector<scene::DirectionalLight> lamps(int count) {
    std::vector<scene::DirectionalLight> result;
    for (int lamp = 0; lamp < count; ++lamp)
        result.push_back({.direction = glm::vec3(lamp_direction(lamp, count)),
                          .irradiance = glm::vec3(static_cast<float>(kIrradiance / count))});
    return result;
}

/// A probe of a dim room with the same lamps, six degrees wide; none of them becomes a key light.
lighting::LightProbe lamp_room(int count) {
    lighting::StudioRecipe room{
        .ceiling = glm::dvec3(0.05), .wall = glm::dvec3(0.04), .floor = glm::dvec3(0.03), .boxes = {}};
    const double solid_angle = std::pow(glm::radians(2.0 * kHalfSize_deg), 2.0);
    for (int lamp = 0; lamp < count; ++lamp) {
        const glm::dvec3 d = lamp_direction(lamp, count);
        room.boxes.push_back({.azimuth_deg = glm::degrees(std::atan2(d.x, -d.z)),
                              .elevation_deg = glm::degrees(std::asin(d.y)),
                              .half_width_deg = kHalfSize_deg,
                              .half_height_deg = kHalfSize_deg,
                              .radiance = glm::dvec3(kIrradiance / count / solid_angle)});
    }
    const lighting::ProbeImage picture(lighting::render_studio(room, kProbeWidth), lighting::Mapping::Equirectangular);
    lighting::LightProbeSettings settings;
    settings.key_lights = 0;
    return lighting::build_light_probe(picture, settings);
}

constexpr int kSide = 256;
constexpr std::uint8_t kRotation = 64;  ///< π / 4
constexpr std::uint8_t kPitch = 128;    ///< half of the range: the material's

/// A map of one direction and the material's pitch: what a map costs, whatever it holds.
std::shared_ptr<const diffraction::GrooveMap> even_grooves() {
    auto picture = std::make_shared<image::ByteImage>();
    picture->width = kSide;
    picture->height = kSide;
    for (int i = 0; i < kSide * kSide; ++i)
        picture->rgba.insert(picture->rgba.end(), {kRotation, kPitch, std::uint8_t{0}, std::uint8_t{255}});
    scene::ImportedScene scene;
    scene.images = {picture};
    scene.textures = {{}};
    render::SurfaceTextures textures(scene);
    return std::make_shared<const diffraction::GrooveMap>(diffraction::GrooveTexture{}, textures, "groove map", "");
}

using Clock = std::chrono::steady_clock;

constexpr float kFieldOfView = 0.9F;
constexpr int kSettlingFrames = 2;  ///< maps are filled in the second frame at rest

std::filesystem::path cooked_folder() {
    return program_prefix() / "cooked";
}

/// From above; the disc covers half the picture.
scene::Camera camera() {
    scene::Camera result;
    result.eye = {0.0F, 0.096F, 0.02F};
    result.vertical_field_of_view = kFieldOfView;
    return result;
}

lighting::LightProbe probe_of(const FrameVariant& variant) {
    if (variant.lighting == Lighting::LampsInProbe) return lamp_room(variant.lamps);
    if (variant.lighting == Lighting::LampsInScene) return lamp_room(0);
    const auto probe = asset::load(cooked_folder() / "studio.probe", "probe", lighting::kLightProbeVersion);
    return lighting::deserialise(probe.payload, "studio.probe");
}

render::Effects effects_of(Effect effect) {
    render::Effects effects;
    if (effect == Effect::AmbientOcclusion) effects.ambient_occlusion = render::AmbientOcclusionSettings{};
    if (effect == Effect::SoftShadow) effects.soft_shadows = render::SoftShadowSettings{};
    effects.local_reflections = effect == Effect::LocalReflection;
    effects.rough_reflections = effect == Effect::RoughReflection;
    return effects;
}

}  // namespace

FrameStage::FrameStage(glm::ivec2 size, diffraction::MapPace map_pace)
    : xyz_to_working_(post::xyz_to_scene_linear(post::OcioConfig::shipped())),
      map_pace_(map_pace),
      picture_({.width = size.x, .height = size.y, .depth = true}),
      disc_(render::make_mesh_instance(
          scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.0235, .outer_radius = 0.058}))) {
    ROWLAND_CHECK_OP(disc_.mesh->positions.size(), ==, 25'000U);
}

std::unique_ptr<render::Renderer> FrameStage::make_renderer(const FrameVariant& variant) const {
    auto renderer = std::make_unique<render::Renderer>(xyz_to_working_);
    diffraction::DiffractionSettings settings;
    settings.map_pace = map_pace_;
    diffraction::register_module(*renderer, settings);
    thin_film::register_module(*renderer);
    renderer->add_material_type(std::make_unique<trade::LightLoopType>());
    renderer->add_material_type(std::make_unique<evidence::PeerType>());
    renderer->set_probe(probe_of(variant));
    renderer->use_key_lights(variant.lighting == Lighting::StudioKeyLights);
    renderer->set_effects(effects_of(variant.effect));
    return renderer;
}

render::Renderer& FrameStage::renderer(const FrameVariant& variant) {
    const bool in_probe = variant.lighting == Lighting::LampsInProbe;
    auto& renderer = renderers_[{variant.lighting, in_probe ? variant.lamps : 0, variant.effect}];
    if (!renderer) renderer = make_renderer(variant);
    return *renderer;
}

const diffraction::CookedMaterial& FrameStage::cooked(const nlohmann::json& material) {
    const std::string key = material.dump();
    const auto found = cooked_.find(key);
    if (found != cooked_.end()) return found->second;
    return cooked_.emplace(key, diffraction::cook_material(material, "the CD")).first->second;
}

std::shared_ptr<const diffraction::GpuMaterial> FrameStage::material(const FrameVariant& variant) {
    auto& material = materials_[{variant.material.dump(), &renderer(variant)}];
    if (!material) material = diffraction::make_gpu_material(cooked(variant.material), xyz_to_working_);
    return material;
}

std::shared_ptr<const diffraction::GrooveMap> FrameStage::groove_map() {
    if (!groove_map_) groove_map_ = even_grooves();
    return groove_map_;
}

void FrameStage::draw(const FrameVariant& variant, ecs::World& world, render::Shading shading) {
    renderer(variant).render(world, camera(), picture_, shading);
}

FrameScene::FrameScene(FrameVariant variant, FrameStage& stage, bool software)
    : variant_(std::move(variant)), stage_(&stage), software_(software) {
    disc_ = world_.create();
    world_.add(disc_, scene::Transform{});
    world_.add(disc_, render::MeshInstance(stage.disc()));
    const FrameVariant grating{.name = {},
                               .baseline = {},
                               .material = cd_material({{"representation", "direct"}}),
                               .lighting = variant_.lighting,
                               .lamps = variant_.lamps};
    world_.add(disc_, stage.material(variant_.shader == Shader::Grating ? variant_ : grating)->base());
    if (variant_.shader == Shader::Grating)
        world_.add(disc_,
                   diffraction::DiffractionSurface{.material = stage.material(variant_),
                                                   .grooves = variant_.groove_map ? stage.groove_map() : nullptr});
    if (variant_.mean_colour) {
        world_.add(world_.create(), diffraction::FrameBudget{1e9});
        world_.add(disc_, diffraction::RecordedRung{0});
    }
    if (variant_.shader == Shader::Film) add_film();
    if (variant_.worn) add_wear();
    if (variant_.in_box || variant_.between_boxes) add_box();
    if (variant_.instance) add_instances();
    if (variant_.lighting == Lighting::LampsInScene) {
        std::vector<render::DistantLight> distant;
        for (const scene::DirectionalLight& lamp : lamps(variant_.lamps)) {
            world_.add(world_.create(), scene::DirectionalLight(lamp));
            distant.push_back({lamp.direction, lamp.irradiance});
        }
        if (variant_.shader == Shader::LightLoop) shade_in_a_loop(distant);
        if (variant_.shader == Shader::Peer) shade_by_peer(distant);
    } else {
        world_.add(world_.create(), scene::DirectionalLight{.direction = glm::normalize(glm::vec3(0.3F, 1.0F, 0.4F)),
                                                            .irradiance = glm::vec3(0.5F),
                                                            .casts_shadow = variant_.shadow});
    }
    if (variant_.effect == Effect::LocalReflection) add_reflected_plane();
    scene::update_world_matrices(world_);
}

void FrameScene::add_instances() {
    for (int i = 1; i < render::kLeastInstances; ++i) {
        const ecs::Entity entity = world_.create();
        world_.add(entity, scene::Transform{.translation = {100.0F * static_cast<float>(i), 0.0F, 0.0F}});
        world_.add(entity, render::MeshInstance(world_.get<render::MeshInstance>(disc_)));
        world_.add(entity, render::StandardMaterial(world_.get<render::StandardMaterial>(disc_)));
        if (const auto* surface = world_.find<diffraction::DiffractionSurface>(disc_))
            world_.add(entity, diffraction::DiffractionSurface(*surface));
    }
}

void FrameScene::add_box() {
    constexpr float kHalf_m = 5.0F;
    const ecs::Entity box = world_.create();
    // Half a metre beside the disc, over a fade of one, or around it.
    world_.add(box, scene::Transform{.translation = {variant_.between_boxes ? kHalf_m + 0.5F : 0.0F, 0.0F, 0.0F}});
    world_.add(box, render::ProbeVolume{.probe = std::make_shared<const lighting::LightProbe>(probe_of(variant_)),
                                        .half = glm::vec3(kHalf_m)});
}

void FrameScene::add_film() {
    thin_film::CookedFilm film = thin_film::cook_film(variant_.material, "the film");
    if (variant_.thickness_map) {
        film.material.range.thinnest_nm = 100.0;
        film.table = thin_film::bake_film(film.material);
    }
    thin_film::add_film(world_, disc_, film, stage_->xyz_to_working());
    if (!variant_.thickness_map) return;
    auto map = std::make_shared<gpu::Texture>(gpu::TextureDesc{.format = gpu::Format::RGBA8, .width = 64, .height = 1});
    std::vector<std::uint8_t> ramp;
    for (int i = 0; i < 64; ++i)
        for (int c = 0; c < 4; ++c) ramp.push_back(static_cast<std::uint8_t>(4 * i));
    map->upload(std::span<const std::uint8_t>(ramp));
    world_.get<render::StandardMaterial>(disc_).base_colour = glm::vec3(0.5F);  // what passes is seen
    auto& surface = world_.get<thin_film::FilmSurface>(disc_);
    surface.minimum_thickness_nm = 100.0F;
    surface.thickness_texture.texture = std::move(map);
}

void FrameScene::add_wear() {
    const image::ByteImage marks = scene::wear_map({.scratches = 0.3F, .fingerprints = 0.5F, .dust = 0.3F});
    auto map = std::make_shared<gpu::Texture>(
        gpu::TextureDesc{.format = gpu::Format::RGBA8, .width = marks.width, .height = marks.height, .levels = 0},
        gpu::Sampling{.filter = gpu::Filter::Trilinear});
    map->upload(std::span<const std::uint8_t>(marks.rgba));
    map->generate_levels();
    world_.get<render::StandardMaterial>(disc_).wear_texture.texture = std::move(map);
}

/// Above the camera, so that it is not in the picture; its top faces down.
void FrameScene::add_reflected_plane() {
    constexpr float kHeight = 0.2F;
    constexpr float kHalf = 0.5F;
    const ecs::Entity plane = world_.create();
    world_.add(plane, scene::Transform{.translation = {0.0F, kHeight, 0.0F},
                                       .rotation = glm::angleAxis(glm::pi<float>(), glm::vec3(1.0F, 0.0F, 0.0F))});
    world_.add(plane, render::MeshInstance(stage_->disc()));
    world_.add(plane, render::StandardMaterial{});
    world_.add(plane, render::ReflectedTop{.half = glm::vec2(kHalf)});
}

void FrameScene::shade_in_a_loop(const std::vector<render::DistantLight>& lights) {
    const diffraction::Grating grating =
        diffraction::parse_material(cd_material({{"representation", "direct"}}), "the CD").grating;
    auto loop = std::make_shared<trade::LightLoop>(grating, colour::LightSpectra(), stage_->xyz_to_working());
    loop->set_lights(lights);
    world_.add(disc_, trade::LightLoopSurface{std::move(loop)});
}

void FrameScene::shade_by_peer(const std::vector<render::DistantLight>& lights) {
    world_.add(disc_, evidence::PeerSurface{&evidence::peer_named(variant_.peer),
                                            std::make_shared<const gpu::Buffer>(evidence::light_buffer(lights))});
}

FrameTime FrameScene::draw() {
    const render::Shading shading = variant_.shader == Shader::Unlit ? render::Shading::Unlit : render::Shading::Full;
    times_.begin_frame();
    const Clock::time_point start = Clock::now();
    const std::clock_t work_start = std::clock();
    {
        const gpu::PassTimes::Scope scope(software_ ? nullptr : &times_, "frame");
        stage_->draw(variant_, world_, shading);
    }
    glFinish();
    FrameTime time;
    time.work_ms = 1e3 * static_cast<double>(std::clock() - work_start) / CLOCKS_PER_SEC;
    time.wall_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (software_) return time;
    times_.begin_frame();  // reads what the GPU has finished
    time.work_ms = times_.latest().at(0).gpu_ms.value();
    return time;
}

bool FrameScene::awaits_map() {
    const auto* state = world_.find<diffraction::SurfaceState>(disc_);
    return state != nullptr && state->without_map && state->map.is_filling();
}

void FrameScene::settle() {
    for (int frame = 0; frame < kSettlingFrames; ++frame) draw();
}

}  // namespace rowland::benchmark

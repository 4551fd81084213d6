#include "tests/benchmark/walk_rooms.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <memory>

#include "engine/asset/container.h"
#include "engine/colour/colour_space.h"
#include "engine/lighting/light_probe.h"
#include "engine/live/live_assets.h"
#include "engine/render/gpu_mesh.h"
#include "engine/scene/mesh_recipe.h"
#include "engine/scene/transform.h"
#include "modules/asset_types.h"
#include "modules/diffraction/module.h"
#include "modules/diffraction/runtime/diffraction_surface.h"
#include "modules/material_types.h"

namespace rowland::benchmark {

namespace {

using Clock = std::chrono::steady_clock;

}  // namespace

scene::Camera camera_at(float x_m, const glm::vec3& forward) {
    const glm::vec3 eye(x_m, kEyeHeight_m, 0.0F);
    return {.eye = eye, .target = eye + forward, .vertical_field_of_view = 0.9F, .near_plane = 0.02F};
}

scene::Camera camera_at_stop(int stop, int stops) {
    constexpr std::array kForward = {glm::vec3(1, -0.15F, 0), glm::vec3(0, -0.15F, -1), glm::vec3(-1, -0.15F, 0),
                                     glm::vec3(0, -0.15F, 1)};
    const float part = (static_cast<float>(stop) + 0.5F) / static_cast<float>(stops);
    return camera_at(kBegin_m + (kEnd_m - kBegin_m) * part, kForward[static_cast<std::size_t>(stop) % kForward.size()]);
}

double white_of(std::span<const glm::vec4> pixels) {
    double sum = 0.0;
    for (const glm::vec4& pixel : pixels) sum += static_cast<double>(pixel.y);
    return sum / static_cast<double>(pixels.size()) / 0.18;
}

double display_value(float radiance, double white) {
    return 255.0 * std::pow(std::clamp(static_cast<double>(radiance) / white, 0.0, 1.0), 1.0 / 2.2);
}

Rooms::Rooms(const WalkOptions& options, std::optional<std::size_t> one_probe)
    : renderer_(glm::inverse(colour::rec709_to_xyz())) {
    modules::register_material_types(renderer_);
    const auto registry = modules::asset_types();
    std::vector<std::filesystem::path> files;
    const scene::ImportedScene scene = live::load_scene(*registry, options.scene, {}, files);
    const auto& sky = options.scene.parent_path() / "evening.probe";
    const auto cooked = asset::load(sky, "probe", lighting::kLightProbeVersion);
    renderer_.set_probe(lighting::deserialise(cooked.payload, sky.string()));
    renderer_.use_key_lights(true);
    instance_ = render::instantiate(world_, scene, renderer_, options.scene.string());
    scene::update_world_matrices(world_);
    volumes_ = render::gather_volumes(world_);
    if (!one_probe) return;
    renderer_.set_probe(lighting::LightProbe(*volumes_.probes.at(*one_probe)));
    remove_boxes();
}

void Rooms::remove_boxes() {
    for (const ecs::Entity box : instance_.probes) world_.destroy(box);
    instance_.probes.clear();
}

void Rooms::carry_gratings() {
    std::map<bool, std::shared_ptr<const diffraction::GpuMaterial>> materials;  // by whether they are for discs
    world_.view<diffraction::DiffractionSurface>().each(
        [&](ecs::Entity, const diffraction::DiffractionSurface& surface) {
            const auto& measured = surface.material->cooked()->measured;
            if (measured && !surface.material->base().passes_light)
                materials.emplace(measured->surface == diffraction::SurfaceShape::Flat, surface.material);
        });
    const std::array meshes = {
        scene::build_mesh(scene::SphereRecipe{.radius = 0.05}),
        scene::build_mesh(scene::DiscRecipe{.inner_radius = 0.01, .outer_radius = 0.06, .rings = 4, .segments = 64})};
    for (const bool is_disc : {false, true}) {
        const ecs::Entity entity = carried_.emplace_back(world_.create());
        world_.add(entity, scene::Transform{});
        world_.add(entity, render::make_mesh_instance(meshes[is_disc ? 1 : 0]));
        world_.add(entity, render::StandardMaterial{});
        diffraction::add_surface(world_, entity, {.material = materials.at(is_disc)}, true);
    }
}

void Rooms::carry_at(const scene::Camera& camera) {
    const glm::vec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, camera.up));
    for (std::size_t i = 0; i < carried_.size(); ++i)
        world_.get<scene::Transform>(carried_[i]) = {
            .translation = camera.eye + 0.4F * forward + (i == 0 ? -0.08F : 0.08F) * right,
            .rotation = glm::angleAxis(1.2F, right)};
    scene::update_world_matrices(world_);
}

double Rooms::draw_ms(const scene::Camera& camera, const gpu::Framebuffer& target) {
    const Clock::time_point start = Clock::now();
    renderer_.render(world_, camera, target);
    glFinish();
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace rowland::benchmark

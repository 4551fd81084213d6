#include "engine/render/effects.h"

#include <cmath>
#include <glm/mat3x3.hpp>

#include "engine/core/check.h"

namespace rowland::render {

namespace {

constexpr unsigned kSourceUnit = 0;

}  // namespace

const gpu::Framebuffer& AmbientOcclusion::begin(glm::ivec2 picture) {
    const glm::ivec2 size = (picture + 1) / 2;
    if (!targets_ || targets_->depth.size() != size)
        targets_.emplace(Targets{gpu::Framebuffer({.width = size.x, .height = size.y, .colours = {}, .depth = true}),
                                 gpu::Framebuffer({.width = size.x, .height = size.y}),
                                 gpu::Framebuffer({.width = size.x, .height = size.y})});
    targets_->depth.bind();
    targets_->depth.clear_depth();
    return targets_->depth;
}

void AmbientOcclusion::draw(ProgramCache& programs, const scene::Camera& camera, float aspect,
                            const std::optional<glm::vec3>& toward_light, const AmbientOcclusionSettings& settings) {
    ROWLAND_CHECK_OP(settings.radius_m, >, 0.0F);
    const float half_height = std::tan(0.5F * camera.vertical_field_of_view);
    const gpu::Program& occlusion = programs.get(gpu::full_screen_pass("engine/render/shaders/occlusion.frag.glsl"));
    occlusion.use();
    occlusion.set("extent", glm::vec2(aspect * half_height, half_height));
    occlusion.set("planes", glm::vec2(camera.near_plane, camera.far_plane));
    occlusion.set("radius", settings.radius_m);
    occlusion.set("contact", toward_light ? settings.contact_m : 0.0F);
    occlusion.set("toward_light", glm::mat3(camera.view()) * toward_light.value_or(glm::vec3(0.0F, 1.0F, 0.0F)));
    targets_->depth.depth().bind(kSourceUnit);
    triangle_.draw(occlusion, targets_->smooth);

    const gpu::Program& mean = programs.get(gpu::full_screen_pass("engine/render/shaders/occlusion_mean.frag.glsl"));
    mean.use();
    mean.set("axis", glm::ivec2(1, 0));
    targets_->smooth.colour().bind(kSourceUnit);
    triangle_.draw(mean, targets_->across);
    mean.set("axis", glm::ivec2(0, 1));
    targets_->across.colour().bind(kSourceUnit);
    triangle_.draw(mean, targets_->smooth);
}

}  // namespace rowland::render

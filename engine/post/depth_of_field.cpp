#include "engine/post/depth_of_field.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

constexpr float kSensorHeight_m = 0.024F;

/// Radius at infinity in picture heights, and the distance in focus.
struct Blur {
    float at_infinity = 0.0F;
    float focus_m = 0.0F;
};

Blur blur_of(const DepthOfFieldSettings& settings, const LensView& view) {
    const float focal_length_m = 0.5F * kSensorHeight_m / std::tan(0.5F * view.vertical_fov);
    const float focus_m = std::max(settings.focus_m.value_or(view.target_m), 1.1F * focal_length_m);
    const float aperture_m = focal_length_m / settings.f_number;
    return {0.5F * aperture_m * focal_length_m / (kSensorHeight_m * (focus_m - focal_length_m)), focus_m};
}

}  // namespace

float blur_radius(const DepthOfFieldSettings& settings, const LensView& view, float distance_m) {
    const Blur blur = blur_of(settings, view);
    return blur.at_infinity * (distance_m - blur.focus_m) / distance_m;
}

DepthOfFieldPass::DepthOfFieldPass(const gpu::ShaderLibrary& library)
    : discs_program_(library, gpu::full_screen_pass("engine/post/shaders/blur_discs.frag.glsl")),
      widest_program_(library, gpu::full_screen_pass("engine/post/shaders/blur_widest.frag.glsl")),
      gather_program_(library, gpu::full_screen_pass("engine/post/shaders/blur_gather.frag.glsl")) {}

void DepthOfFieldPass::draw(const gpu::Texture& source, const gpu::Texture& depth, const DepthOfFieldSettings& settings,
                            const LensView& view, const gpu::Framebuffer& target) {
    require_valid(settings);
    const glm::ivec2 size = source.size();
    ROWLAND_CHECK(size == target.size() && size == depth.size(), "a blur between pictures of different size");
    const float most = settings.most_blur * static_cast<float>(size.y);
    const int tile = std::max(1, static_cast<int>(std::ceil(most)));
    const glm::ivec2 tiles = (size + tile - 1) / tile;
    if (!targets_ || targets_->discs.size() != size || targets_->widest.size() != tiles) {
        gpu::Texture discs({.width = size.x, .height = size.y, .levels = 0}, {.filter = gpu::Filter::Trilinear});
        gpu::Framebuffer onto_discs = gpu::Framebuffer::onto(discs);
        targets_.emplace(
            Targets{std::move(discs), std::move(onto_discs),
                    gpu::Framebuffer({.width = tiles.x, .height = tiles.y, .colours = {gpu::Format::R32F}})});
    }
    const Blur blur = blur_of(settings, view);
    discs_program_.set("planes", glm::vec2(view.near_plane, view.far_plane));
    discs_program_.set("blur", glm::vec3(blur.at_infinity * static_cast<float>(size.y), blur.focus_m, most));
    source.bind(0);
    depth.bind(1);
    triangle_.draw(discs_program_, targets_->onto_discs);
    targets_->discs.generate_levels();

    widest_program_.set("tile", tile);
    targets_->discs.bind(0);
    triangle_.draw(widest_program_, targets_->widest);

    gather_program_.set("tile", tile);
    gather_program_.set("into_halves", target.holds_halves() ? 1 : 0);
    source.bind(0);
    targets_->discs.bind(1);
    targets_->widest.colour().bind(2);
    triangle_.draw(gather_program_, target);
}

void require_valid(const DepthOfFieldSettings& settings) {
    ROWLAND_CHECK_OP(settings.f_number, >=, 0.5F);
    ROWLAND_CHECK_OP(settings.f_number, <=, 64.0F);
    ROWLAND_CHECK_OP(settings.focus_m.value_or(1.0F), >, 0.0F);
    ROWLAND_CHECK_OP(settings.most_blur, >, 0.0F);
    ROWLAND_CHECK_OP(settings.most_blur, <=, 0.1F);
}

}  // namespace rowland::post

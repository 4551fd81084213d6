#include "engine/post/auto_exposure.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

constexpr int block = 8;  // as in the shader

gpu::Program program(const gpu::ShaderLibrary& library, bool is_picture) {
    return {library,
            {.vertex = gpu::full_screen_vertex_shader,
             .fragment = "engine/post/shaders/log_luminance_sum.frag.glsl",
             .defines = {{"SOURCE_IS_PICTURE", is_picture ? "1" : "0"}}}};
}

}  // namespace

AutoExposurePass::AutoExposurePass(const gpu::ShaderLibrary& library)
    : sum_picture_(program(library, true)), sum_sums_(program(library, false)) {}

void AutoExposurePass::make_sums(glm::ivec2 size) {
    if (size == size_) return;
    size_ = size;
    sums_.clear();
    do {
        size = (size + block - 1) / block;
        sums_.emplace_back(gpu::FramebufferDesc{.width = size.x, .height = size.y, .colours = {gpu::Format::RG32F}});
    } while (size != glm::ivec2(1));
}

std::optional<double> AutoExposurePass::measure(const gpu::Texture& picture, const glm::vec3& weights, float darkest) {
    make_sums(picture.size());
    sum_picture_.set("weights", weights);
    sum_picture_.set("darkest", darkest);
    picture.bind(0);
    triangle_.draw(sum_picture_, sums_.front());
    for (std::size_t i = 1; i < sums_.size(); ++i) {
        sums_[i - 1].colour().bind(0);
        triangle_.draw(sum_sums_, sums_[i]);
    }
    const glm::dvec4 total(sums_.back().colour().read().front());
    if (total.g == 0.0) return std::nullopt;
    return total.r / total.g;
}

float target_stops(double mean_log2, const AutoExposureSettings& settings) {
    const double stops = std::log2(static_cast<double>(settings.key)) - mean_log2;
    return std::clamp(static_cast<float>(stops), settings.min_stops, settings.max_stops);
}

float adapted_stops(float stops, float target, float seconds, const AutoExposureSettings& settings) {
    ROWLAND_CHECK_OP(seconds, >=, 0.0F);
    const float speed = target > stops ? settings.speed_up : settings.speed_down;
    return stops - (target - stops) * std::expm1(-speed * seconds);
}

void require_valid(const AutoExposureSettings& settings) {
    ROWLAND_CHECK_OP(settings.key, >, 0.0F);
    ROWLAND_CHECK_OP(settings.darkest, >, 0.0F);
    ROWLAND_CHECK_OP(settings.min_stops, <=, settings.max_stops);
    ROWLAND_CHECK_OP(settings.speed_up, >=, 0.0F);
    ROWLAND_CHECK_OP(settings.speed_down, >=, 0.0F);
}

}  // namespace rowland::post

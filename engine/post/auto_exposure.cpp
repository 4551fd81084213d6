#include "engine/post/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "engine/core/check.h"

namespace rowland::post {

namespace {

// As in the shader.
constexpr int block = 8;
constexpr unsigned kTotalBinding = 0;

gpu::Program program(const gpu::ShaderLibrary& library, bool is_picture) {
    return {library, gpu::full_screen_pass("engine/post/shaders/log_luminance_sum.frag.glsl",
                                           {{"SOURCE_IS_PICTURE", is_picture ? "1" : "0"}})};
}

}  // namespace

AutoExposurePass::AutoExposurePass(const gpu::ShaderLibrary& library)
    : sum_picture_(program(library, true)),
      sum_sums_(program(library, false)),
      totals_(gpu::Buffer::mapped(kMaxInFlight * gpu::kBufferAlignment, GL_MAP_READ_BIT)) {}

void AutoExposurePass::make_sums(glm::ivec2 size) {
    if (size == size_) return;
    size_ = size;
    sums_.clear();
    do {
        size = (size + block - 1) / block;
        sums_.emplace_back(gpu::FramebufferDesc{.width = size.x, .height = size.y, .colours = {gpu::Format::RG32F}});
    } while (size != glm::ivec2(1));
}

void AutoExposurePass::sum(const gpu::Program& program, const gpu::Texture& source, std::size_t pass) {
    program.set("is_total", pass + 1 == sums_.size() ? 1 : 0);
    source.bind(0);
    triangle_.draw(program, sums_[pass]);
}

void AutoExposurePass::start(const gpu::Texture& picture, const glm::vec3& weights, float darkest) {
    last_ = (last_ + 1) % kMaxInFlight;
    if (finished_[last_] && !finished_[last_]->passed()) finished_[last_]->wait();
    make_sums(picture.size());
    totals_.bind_storage(kTotalBinding, last_ * gpu::kBufferAlignment, sizeof(glm::vec2));
    sum_picture_.set("weights", weights);
    sum_picture_.set("darkest", darkest);
    sum(sum_picture_, picture, 0);
    for (std::size_t pass = 1; pass < sums_.size(); ++pass) sum(sum_sums_, sums_[pass - 1].colour(), pass);
    glMemoryBarrier(GL_CLIENT_MAPPED_BUFFER_BARRIER_BIT);
    finished_[last_].emplace();
}

std::size_t AutoExposurePass::index_of(std::size_t age) const {
    return (last_ + kMaxInFlight - age) % kMaxInFlight;
}

MeanLog2Luminance AutoExposurePass::read(std::size_t age) {
    glm::vec2 total(0.0F);
    std::memcpy(&total, &totals_.mapping()[index_of(age) * gpu::kBufferAlignment], sizeof(total));
    // Results of older measurements are not used any more.
    for (; age < kMaxInFlight; ++age) finished_[index_of(age)].reset();
    if (total.g == 0.0F) return std::nullopt;
    return double{total.r} / double{total.g};
}

std::optional<MeanLog2Luminance> AutoExposurePass::take() {
    for (std::size_t age = 0; age < kMaxInFlight; ++age) {
        const std::optional<gpu::Fence>& finished = finished_[index_of(age)];
        if (finished && finished->passed()) return read(age);
    }
    return std::nullopt;
}

MeanLog2Luminance AutoExposurePass::wait() {
    ROWLAND_CHECK(finished_[last_].has_value(), "a measurement that was started and not returned yet");
    finished_[last_]->wait();
    return read(0);
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

#include "engine/post/bloom.h"

#include "engine/core/check.h"

namespace rowland::post {

namespace {

gpu::Program program(const gpu::ShaderLibrary& library, const char* fragment, bool is_picture) {
    return {library, gpu::full_screen_pass(fragment, {{"FINE_IS_PICTURE", is_picture ? "1" : "0"}})};
}

constexpr const char* down_shader = "engine/post/shaders/bloom_down.frag.glsl";
constexpr const char* up_shader = "engine/post/shaders/bloom_up.frag.glsl";

}  // namespace

BloomPass::BloomPass(const gpu::ShaderLibrary& library)
    : downsample_picture_(program(library, down_shader, true)),
      downsample_level_(program(library, down_shader, false)),
      upsample_level_(program(library, up_shader, false)),
      upsample_picture_(program(library, up_shader, true)) {}

void BloomPass::make_levels(glm::ivec2 size, int levels) {
    const std::vector<glm::ivec2> sizes = bloom_level_sizes(size, levels);
    if (down_.size() == sizes.size() && down_.front().size() == sizes.front()) return;
    down_.clear();
    up_.clear();
    for (const glm::ivec2 level_size : sizes) {
        const gpu::FramebufferDesc desc{
            .width = level_size.x, .height = level_size.y, .colours = {gpu::Format::RGBA16F}};
        down_.emplace_back(desc);
        if (down_.size() < sizes.size()) up_.emplace_back(desc);
    }
}

void BloomPass::downsample(const gpu::Program& program, const gpu::Texture& fine, const gpu::Framebuffer& target) {
    fine.bind(0);
    program.set("coarse_size", target.size());
    triangle_.draw(program, target);
    ++passes_;
}

void BloomPass::upsample_and_mix(const gpu::Program& program, const gpu::Texture& fine, const gpu::Texture& coarse,
                                 float weight, const gpu::Framebuffer& target) {
    fine.bind(0);
    coarse.bind(1);
    program.set("coarse_weight", weight);
    program.set("into_halves", target.holds_halves() ? 1 : 0);
    triangle_.draw(program, target);
    ++passes_;
}

void BloomPass::draw(const gpu::Texture& source, const BloomSettings& settings, const gpu::Framebuffer& target) {
    require_valid(settings);
    ROWLAND_CHECK(source.size() == target.size(), "the target of bloom must have the source's size");
    passes_ = 0;
    make_levels(source.size(), settings.levels);
    downsample(downsample_picture_, source, down_.front());
    for (std::size_t i = 1; i < down_.size(); ++i) downsample(downsample_level_, down_[i - 1].colour(), down_[i]);
    const gpu::Texture* blurred = &down_.back().colour();
    for (std::size_t i = up_.size(); i-- > 0;) {
        upsample_and_mix(upsample_level_, down_[i].colour(), *blurred, bloom_coarser_weight(i, down_.size()), up_[i]);
        blurred = &up_[i].colour();
    }
    upsample_and_mix(upsample_picture_, source, *blurred, settings.strength, target);
}

void require_valid(const BloomSettings& settings) {
    ROWLAND_CHECK_OP(settings.strength, >=, 0.0F);
    ROWLAND_CHECK_OP(settings.strength, <=, 1.0F);
    ROWLAND_CHECK_OP(settings.levels, >=, 1);
}

std::vector<glm::ivec2> bloom_level_sizes(glm::ivec2 picture, int levels) {
    std::vector<glm::ivec2> sizes;
    do {
        picture = (picture + 1) / 2;
        sizes.push_back(picture);
    } while (static_cast<int>(sizes.size()) < levels && picture != glm::ivec2(1));
    return sizes;
}

float bloom_coarser_weight(std::size_t index, std::size_t count) {
    return static_cast<float>(count - index - 1) / static_cast<float>(count - index);
}

}  // namespace rowland::post

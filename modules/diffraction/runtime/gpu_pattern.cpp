#include "modules/diffraction/runtime/gpu_pattern.h"

#include <algorithm>
#include <glm/gtx/component_wise.hpp>
#include <glm/vec4.hpp>

#include "modules/diffraction/runtime/bindings.h"

namespace rowland::diffraction {

GpuPattern::GpuPattern(const Material& material, const glm::dmat3& xyz_to_working)
    : grating_(material.grating), illuminant_(material.quality.illuminant), xyz_to_working_(xyz_to_working) {}

void GpuPattern::upload(std::span<const glm::vec3> light_colours) const {
    if (!picture_) {
        picture_ = pattern_picture(grating_, colour::LightSpectra(illuminant_));
        largest_ = 1e-30F;
        const glm::mat3 to_working(xyz_to_working_);
        for (PatternPicture::Level& level : picture_->levels)
            for (glm::mat3& density : level.density) {
                density = to_working * density;
                for (int c = 0; c < 3; ++c) largest_ = std::max(largest_, glm::compMax(glm::abs(density[c])));
            }
    }
    colours_.assign(light_colours.begin(), light_colours.end());
    texture_.emplace(gpu::TextureDesc{.kind = gpu::TextureKind::PlaneArray,
                                      .format = gpu::Format::RGBA16F,
                                      .width = picture_->levels[0].size,
                                      .height = picture_->levels[0].size,
                                      .depth = kFirstColourLayer + static_cast<int>(colours_.size()),
                                      .levels = static_cast<int>(picture_->levels.size())},
                     gpu::Sampling{.filter = gpu::Filter::Trilinear});
    const auto upload_layer = [&](const glm::vec3& colour, int layer) {
        for (std::size_t level = 0; level < picture_->levels.size(); ++level) {
            std::vector<glm::vec3> texels;
            texels.reserve(picture_->levels[level].density.size());
            for (const glm::mat3& density : picture_->levels[level].density)
                texels.push_back(density * colour / largest_);
            texture_->upload(std::span<const glm::vec3>(texels), {.level = static_cast<int>(level), .layer = layer});
        }
    };
    for (int c = 0; c < 3; ++c) upload_layer(glm::mat3(1.0F)[c], c);
    for (std::size_t i = 0; i < colours_.size(); ++i)
        upload_layer(colours_[i], kFirstColourLayer + static_cast<int>(i));
}

void GpuPattern::bind(const gpu::Program& program, std::span<const glm::vec3> light_colours) const {
    if (!program.has_uniform("pattern_scale")) return;
    if (!texture_ || !std::ranges::equal(colours_, light_colours)) upload(light_colours);
    texture_->bind(kKernelUnit);
    program.set("pattern_scale", glm::vec4(glm::dvec4(0.5 / picture_->half_width, picture_->level_bias(),
                                                      double{largest_}, picture_->half_width)));
}

}  // namespace rowland::diffraction

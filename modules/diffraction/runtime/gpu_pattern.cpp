#include "modules/diffraction/runtime/gpu_pattern.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <glm/vec4.hpp>

#include "modules/diffraction/representations/direct/pattern_light.h"
#include "modules/diffraction/runtime/bindings.h"
#include "modules/diffraction/runtime/key_lobe.h"

namespace rowland::diffraction {

namespace {

gpu::Texture layered_texture(int size, std::size_t layers, std::size_t levels) {
    return gpu::Texture({.kind = gpu::TextureKind::PlaneArray,
                         .format = gpu::Format::RGBA16F,
                         .width = size,
                         .height = size,
                         .depth = static_cast<int>(layers),
                         .levels = static_cast<int>(levels)},
                        gpu::Sampling{.filter = gpu::Filter::Trilinear});
}

/// `value(density)`: of a texel.
template <typename Picture, typename ValueOf>
void upload_layer(gpu::Texture& texture, const Picture& picture, std::size_t layer, const ValueOf& value) {
    for (std::size_t level = 0; level < picture.levels.size(); ++level) {
        std::vector<glm::vec3> texels;
        texels.reserve(picture.levels[level].density.size());
        for (const auto& density : picture.levels[level].density) texels.push_back(value(density));
        texture.upload(std::span<const glm::vec3>(texels),
                       {.level = static_cast<int>(level), .layer = static_cast<int>(layer)});
    }
}

float largest_flux(const lighting::KeyLight& light) {
    return std::max(static_cast<float>(glm::compMax(light.flux)), 1e-30F);
}

}  // namespace

GpuPattern::GpuPattern(const Material& material, const glm::dmat3& xyz_to_working)
    : grating_(material.grating), illuminant_(material.quality.illuminant), xyz_to_working_(xyz_to_working) {}

void GpuPattern::upload_colours(std::span<const glm::vec3> light_colours) const {
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
    texture_.emplace(
        layered_texture(picture_->levels[0].size, std::max<std::size_t>(colours_.size(), 1), picture_->levels.size()));
    for (std::size_t i = 0; i < colours_.size(); ++i)
        upload_layer(*texture_, *picture_, i,
                     [&](const glm::mat3& density) { return density * colours_[i] / largest_; });
}

void GpuPattern::upload_key_lights(std::span<const lighting::KeyLight> key_lights) const {
    key_lights_.assign(key_lights.begin(), key_lights.end());
    const std::vector<LightPicture> pictures =
        key_light_pictures(grating_, colour::LightSpectra(illuminant_), key_lights_, xyz_to_working_);
    // Stored as fp16: each layer is divided by its light's flux, and all by the largest component.
    float largest = 1e-30F;
    for (std::size_t i = 0; i < pictures.size(); ++i)
        for (const LightPicture::Level& level : pictures[i].levels)
            for (const glm::vec3& density : level.density)
                largest = std::max(largest, glm::compMax(glm::abs(density)) / largest_flux(key_lights_[i]));
    const LightPicture& first = pictures[0];
    lobe_texture_.emplace(layered_texture(first.levels[0].size, pictures.size(), first.levels.size()));
    for (std::size_t i = 0; i < pictures.size(); ++i)
        upload_layer(*lobe_texture_, pictures[i], i,
                     [&](const glm::vec3& density) { return density / (largest * largest_flux(key_lights_[i])); });
    lobe_scale_ =
        glm::vec4(glm::dvec4(0.5 / first.half_width, first.texel_variance(), double{largest}, first.half_width));
}

void GpuPattern::bind(const gpu::Program& program, std::span<const lighting::KeyLight> key_lights,
                      std::span<const glm::vec3> light_colours) const {
    if (program.has_uniform("pattern_scale")) {
        if (!texture_ || !std::ranges::equal(colours_, light_colours)) upload_colours(light_colours);
        texture_->bind(kKernelUnit);
        // The level of a variance: half its binary logarithm, and this.
        const double bias = -0.5 * std::log2(picture_->texel_variance());
        program.set("pattern_scale",
                    glm::vec4(glm::dvec4(0.5 / picture_->half_width, bias, double{largest_}, picture_->half_width)));
    }
    if (program.has_uniform("pattern_lobe_scale") && !key_lights.empty()) {
        if (!same_lobes(key_lights_, key_lights)) upload_key_lights(key_lights);
        lobe_texture_->bind(kLobeUnit);
        program.set("pattern_lobe_scale", lobe_scale_);
    }
}

}  // namespace rowland::diffraction

#pragma once

#include <glm/vec2.hpp>
#include <vector>

#include "engine/gpu/framebuffer.h"
#include "engine/gpu/program.h"
#include "engine/gpu/shader_library.h"
#include "engine/gpu/texture.h"

namespace rowland::post {

/// Light scattered in the lens. There is no threshold: every pixel scatters the same fraction of its light.
struct BloomSettings {
    float strength = 0.05F;  ///< fraction of the light that is scattered, 0 to 1; at 0 no pass runs
    int levels = 6;          ///< reach: the blur is the mean of blurs 2, 4, ... 2^levels pixels wide; at least 1
};

/// Replaces a scene-linear picture by mix(picture, blurred picture, strength), in RGBA16F.
///
/// The blur keeps the sum over the picture, wherever the light is and whatever the size, and leaves a picture of one
/// colour unchanged. Each level has half the size of the one before, rounded up. W(i,k) are the weights of bilinear
/// upsampling from coarse texels k to fine texel i, positions clamped to the grid, so sum_k W = 1. Downsampling is the
/// transpose; division by the area normalises it at the borders:
///     light'(k) = sum_i W(i,k) light(i)
///     area'(k) = sum_i W(i,k) area(i)
///     value(i) = sum_k W(i,k) light'(k)/area'(k)
/// Then sum_i area(i) value(i) = sum_k light'(k) = sum_i light(i). Inside the picture the kernels are 1-3-3-1, those of
/// Chaikin's subdivision, whose repetition is smooth. Levels are mixed on the way up, as in Jimenez, "Next generation
/// post processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014, but without his gain.
///
/// Non-finite components count as 0, others are clamped to half floats' range, ±65504, in the unblurred picture as
/// well. Values are rounded to nearest halves on every driver, so the sum is kept to 1e-3.
class BloomPass {
 public:
    /// `library` must hold post::shader_files().
    explicit BloomPass(const gpu::ShaderLibrary& library);

    /// Writes the picture with bloom; alpha is kept. Source (RGBA16F or RGBA32F) and target have the same size, else it
    /// is a logic error. Allocates textures when the size or the number of levels changes.
    void draw(const gpu::Texture& source, const BloomSettings& settings, const gpu::Framebuffer& target);

    /// Passes of the last draw: two per level.
    int passes() const { return passes_; }

 private:
    void make_levels(glm::ivec2 size, int levels);
    void downsample(const gpu::Program& program, const gpu::Texture& fine, const gpu::Framebuffer& target);
    void upsample_and_mix(const gpu::Program& program, const gpu::Texture& fine, const gpu::Texture& coarse,
                          float weight, const gpu::Framebuffer& target);

    gpu::Program downsample_picture_;
    gpu::Program downsample_level_;
    gpu::Program upsample_level_;
    gpu::Program upsample_picture_;
    gpu::FullScreenTriangle triangle_;
    std::vector<gpu::Framebuffer> down_;  ///< light and area, finest first
    std::vector<gpu::Framebuffer> up_;    ///< the mixes; one fewer: the coarsest level is not mixed
    int passes_ = 0;
};

/// The sizes of the blur's levels, finest first: at least one, and none beyond 1×1.
std::vector<glm::ivec2> bloom_level_sizes(glm::ivec2 picture, int levels);

/// The weight of the coarser levels when level `index` of `count` is mixed on the way up. With it the result is the
/// mean of all levels.
float bloom_coarser_weight(std::size_t index, std::size_t count);

/// A logic error if strength or levels are out of range.
void require_valid(const BloomSettings& settings);

}  // namespace rowland::post

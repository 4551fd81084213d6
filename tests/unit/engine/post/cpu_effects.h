#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "engine/post/auto_exposure.h"
#include "engine/post/bloom.h"
#include "engine/post/noise.h"
#include "engine/post/vignette.h"

// The effects on the CPU, as plainly as they can be written: what the passes on the GPU are compared with. Pictures are
// scene-linear (display values for dither), row by row; it is a logic error if `size` is not that of `pixels` or the
// settings are out of range.
namespace rowland::post {

void apply_bloom(std::span<glm::vec3> pixels, glm::ivec2 size, const BloomSettings& settings);

/// See AutoExposurePass::measure().
std::optional<double> mean_log2_luminance(std::span<const glm::vec3> pixels, const glm::vec3& weights, float darkest);

/// Noise in steps of the target.
float dither_offset(glm::ivec2 pixel, std::uint32_t frame);
void apply_dither(std::span<glm::vec3> pixels, glm::ivec2 size, std::uint32_t frame, const DitherSettings& settings);

/// Of mean 0 and variance 1.
float grain_offset(glm::ivec2 pixel, std::uint32_t frame);
void apply_grain(std::span<glm::vec3> pixels, glm::ivec2 size, std::uint32_t frame, const GrainSettings& settings);

/// The factor on the light of a pixel.
float vignette_factor(glm::ivec2 pixel, glm::ivec2 size, const VignetteSettings& settings);
void apply_vignette(std::span<glm::vec3> pixels, glm::ivec2 size, const VignetteSettings& settings);

/// Multiplies by 2^stops.
void apply_exposure(std::span<glm::vec3> pixels, float stops);

}  // namespace rowland::post

#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace rowland::post {

/// Noise below one step of the screen, so that slow gradients show no bands.
struct DitherSettings {
    int bits = 8;  ///< of a channel of the target, 1 to 12
};

/// Noise in steps of the target: evenly distributed between -½ and ½ (never either), so that the mean of rounded values
/// is the value. The same for the same pixel and frame on every machine. The fractional parts of an additive lattice of
/// pixels, with the 2D golden ratio (Roberts 2018, "The unreasonable effectiveness of quasirandom sequences"), which
/// fills small areas evenly as blue noise does; frames go on by the golden ratio.
float dither_offset(glm::ivec2 pixel, std::uint32_t frame);

/// Adds dither_offset steps to the display values of a picture, row by row, the same in all channels so that greys stay
/// grey. Rounding to the target's steps is left to it; 0 and 1 still come out as they are. The twin of DitherPass. It
/// is a logic error if `size` is not that of `pixels` or the settings are out of range.
void apply_dither(std::span<glm::vec3> pixels, glm::ivec2 size, std::uint32_t frame, const DitherSettings& settings);

/// The size of a step: 1 / (2^bits - 1). A logic error if the settings are out of range.
float dither_step(const DitherSettings& settings);

}  // namespace rowland::post

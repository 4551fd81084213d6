#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rowland::post {

/// Light scattered in the lens. There is no threshold: every pixel scatters the same share of its light.
struct BloomSettings {
    float strength = 0.05F;  ///< share of the light that is scattered, 0 to 1; at 0 nothing is done
    int levels = 6;          ///< how far: the blur is the even mean of those of 2, 4, ... 2^levels pixels; from 1 on
};

/// Replaces a scene-linear picture, row by row, by mix(picture, blurred picture, strength). The twin of BloomPass.
///
/// The blur keeps the sum over the picture, wherever the light is and whatever the size, and leaves a picture of one
/// colour as it is. Each level halves the one before, rounding up. With W(i,k) the weights by which linear
/// interpolation makes fine texel i from coarse texels k, positions held within the grid (so sum_k W = 1), going down
/// scatters light by W and going up interpolates by W:
///     light'(k) = sum_i W(i,k) light(i),  area'(k) = sum_i W(i,k) area(i),  value(i) = sum_k W(i,k)
///     light'(k)/area'(k).
/// Then sum_i area(i) value(i) = sum_k light'(k) = sum_i light(i). Inside the picture these are the kernels 1-3-3-1 of
/// Chaikin's subdivision, whose repetition is smooth. Levels are mixed on the way up, as in Jimenez, "Next generation
/// post processing in Call of Duty: Advanced Warfare", SIGGRAPH 2014, but without his gain.
///
/// Components that are not finite count as 0, and others are held within the half floats' ±65504; both also in the
/// picture that is mixed in. It is a logic error if `size` is not that of `pixels` or the settings are out of range.
void apply_bloom(std::span<glm::vec3> pixels, glm::ivec2 size, const BloomSettings& settings);

/// The sizes of the blur's levels, finest first: at least one, and none beyond 1×1.
std::vector<glm::ivec2> bloom_level_sizes(glm::ivec2 picture, int levels);

/// The share of the coarser levels in level `index` of `count` on the way up, which makes their mean an even one.
float bloom_coarser_share(std::size_t index, std::size_t count);

/// A logic error if strength or levels are out of range.
void require_valid(const BloomSettings& settings);

}  // namespace rowland::post

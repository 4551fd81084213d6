#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <type_traits>
#include <vector>

#include "modules/diffraction/bake/diffraction_pattern.h"

namespace rowland::diffraction {

/// A diffraction pattern of points as a mip-mapped picture over u, PHYSICS (50): how much light leaves per unit of
/// (u_g, u_h). A texture of GL_LINEAR_MIPMAP_LINEAR, black beyond its border. Every level holds all of the pattern's
/// light, blurred by a normal distribution; each is wider than the one before by about its texels.
/// `Value`: glm::mat3, linear RGB in, XYZ or another space out; glm::vec3 of one light.
template <typename Value>
struct MippedPattern {
    using Precise = std::conditional_t<std::is_same_v<Value, glm::mat3>, glm::dmat3, glm::dvec3>;

    double half_width =
        0.0;  ///< it shows |u_g|, |u_h| up to this: texel i of n is centred on ((2i + 1)/n − 1) half_width
    double variance = 0.0;  ///< of the blur of the finest level, interpolated between its texels
    double growth = 0.0;    ///< level l is blurred by 4^l − 1 of it more
    struct Level {
        int size = 0;                ///< of a side
        std::vector<Value> density;  ///< row by row along h
    };
    std::vector<Level> levels;  ///< each half the size of the one before

    /// As the texture unit interpolates; 0 beyond the border.
    Precise at(const glm::dvec2& u, double level) const;
    /// The variance of the narrowest blur that texels of the finest level show.
    double texel_variance() const;
};

using PatternPicture = MippedPattern<glm::mat3>;
/// What one light sends, blurred by its own extent.
using LightPicture = MippedPattern<glm::vec3>;

/// Side of the finest level.
inline constexpr int kPatternPictureSize = 1024;

/// Where the mean density over a distribution of this variance along each axis is shown, PHYSICS (50). Its widths come
/// from the level alone: the logarithm deviates least.
double level_of(const PatternPicture& picture, double variance);
/// The same of a light, whose levels differ little in width: between two the mixture has the variance.
double level_of(const LightPicture& picture, double variance);

/// As narrow as its texels show.
PatternPicture pattern_picture(const Grating& grating, const colour::LightSpectra& spectra,
                               int size = kPatternPictureSize);

/// The half-width of a picture: twice the pattern's, so that little of it is blurred over the border.
double picture_half_width(const Grating& grating, const colour::LightSpectra& spectra);

/// The pattern of light of one colour, blurred by `variance` or as narrow as its texels show. The second level has
/// twice the variance, or more where its texels show no less.
LightPicture light_picture(const DiffractionPattern& pattern, double half_width, const glm::vec3& flux, double variance,
                           int size);

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "modules/diffraction/bake/diffraction_pattern.h"

namespace rowland::diffraction {

/// A diffraction pattern of points as a mip-mapped picture over u, PHYSICS (50): how much light leaves per unit of
/// (u_g, u_h). A texture of GL_LINEAR_MIPMAP_LINEAR, black beyond its border. Every level holds all of the pattern's
/// light, blurred by a normal distribution about as wide as its texels.
struct PatternPicture {
    double half_width =
        0.0;  ///< it shows |u_g|, |u_h| up to this: texel i of n is centred on ((2i + 1)/n − 1) half_width
    struct Level {
        int size = 0;                    ///< of a side
        std::vector<glm::mat3> density;  ///< row by row along h; linear RGB in, XYZ or another space out
    };
    std::vector<Level> levels;  ///< each half the size of the one before

    /// The mean density over a distribution of this variance along each axis, as the texture unit interpolates.
    glm::dmat3 at(const glm::dvec2& u, double variance) const;
    /// Added to ½ log2 of a variance it gives the level.
    double level_bias() const;
};

/// Side of the finest level.
inline constexpr int kPatternPictureSize = 1024;

PatternPicture pattern_picture(const Grating& grating, const colour::LightSpectra& spectra,
                               int size = kPatternPictureSize);

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <type_traits>
#include <vector>

#include "engine/colour/illuminant.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The diffraction pattern P of a grating over u = (s_g + v_g, s_h + v_h), PHYSICS (6.2): a point for each wavelength
/// of each order, which grooves spread along h by their lobe.
struct DiffractionPattern {
    /// The light of one order and wavelength: P = Σ_nodes weight δ(u_g − node.u_g) D_h(u_h − node.u_h).
    struct Node {
        glm::vec2 u{0.0F};  ///< (u_g, u_h); u_h is 0 for grooves
        float wavelength_nm = 0.0F;
        glm::mat3 weight{0.0F};  ///< η cmf Eᵀ dλ: linear RGB in, XYZ or another space out; η at normal incidence
    };
    std::vector<Node> nodes;
    /// Where η depends on the view: η_i(v_g) = Σ_r by_node[i · count + r] by_view[r · EfficiencyGrid::kViews + j] at
    /// view j of the grid. `count` is the smallest number of terms, at most kMostTerms, whose relative RMS error is at
    /// most kTermError, nodes weighted by their light. Radiance averages over nodes: its error is .3 of that.
    struct ViewTerms {
        std::size_t count = 1;
        std::vector<float> by_node;
        std::vector<float> by_view;
        std::vector<glm::mat3> observed;  ///< cmf Eᵀ dλ of each node

        /// The factor of a term at a view, linear between the grid's.
        double at(std::size_t term, double v_g) const;
    };
    std::optional<ViewTerms> views;
    std::optional<GrooveLobe> lobe;  ///< D_h; none: δ, as of a lattice
    bool even = false;               ///< P(−u) = P(u)
    std::optional<Cover> cover;      ///< whose T(s_n) is not in P
};

inline constexpr double kTermError = 0.02;
inline constexpr std::size_t kMostTerms = 16;

/// Largest distance in u between the nodes of an order.
inline constexpr double kPatternStep = 0.004;

/// The pattern of sharp orders (N → ∞) for |u| ≤ 2, beyond which no pair of directions lies. Nodes of an order are at
/// most `step` apart in u. Nodes of grooves are also at most 1 nm apart; wavelengths of a lattice that are closer than
/// `step` are merged.
DiffractionPattern diffraction_pattern(const Grating& grating, const colour::LightSpectra& spectra,
                                       double step = kPatternStep);

/// The pattern in the frame that a point is shaded in: for a sheet that transmits, lit_from_behind() reverses h.
DiffractionPattern shaded_pattern(const Grating& grating, const colour::LightSpectra& spectra,
                                  double step = kPatternStep);

/// Whether orders m and −m of a grating, or (m, k) and (−m, −k), are equally bright.
bool is_even(const Grating& grating);

/// The pattern in another colour space than XYZ.
DiffractionPattern in_space(DiffractionPattern pattern, const glm::dmat3& xyz_to_space);

/// A diffraction pattern of points as a mip-mapped picture over u, PHYSICS (13.5): how much light leaves per unit of
/// (u_g, u_h). A texture of GL_LINEAR_MIPMAP_LINEAR, black beyond its border. Every level holds all of the pattern's
/// light, blurred by a normal distribution that widens from level to level.
/// `Value`: glm::mat3, linear RGB in, XYZ or another space out; glm::vec3 of one light.
template <typename Value>
struct MippedPattern {
    using Precise = std::conditional_t<std::is_same_v<Value, glm::mat3>, glm::dmat3, glm::dvec3>;

    double half_width = 0.0;  ///< largest |u_g| and |u_h|: texel i of n is centred on ((2i + 1)/n − 1) half_width
    double variance = 0.0;    ///< of the finest level's blur, interpolation between its texels included
    double growth = 0.0;      ///< level l has the variance variance + (4^l − 1) growth
    struct Level {
        int size = 0;                ///< of a side
        std::vector<Value> density;  ///< row by row along h
    };
    std::vector<Level> levels;  ///< each half the size of the one before

    /// The value that the texture unit interpolates; 0 beyond the border.
    Precise at(const glm::dvec2& u, double level) const;
    /// The variance of the narrowest blur that texels of the finest level can show.
    double texel_variance() const;
};

using PatternPicture = MippedPattern<glm::mat3>;
/// The picture of one light, blurred by its extent.
using LightPicture = MippedPattern<glm::vec3>;

/// Texels along a side of the finest level.
inline constexpr int kPatternPictureSize = 1024;

/// The level that shows the mean density over a normal distribution of this variance along each axis, PHYSICS (13.5).
/// Between levels it is linear in the logarithm of the variance, which deviates least.
double level_of(const PatternPicture& picture, double variance);
/// The same for the picture of one light. Its levels differ little in width, so the position between two levels is the
/// one at which their mixture has the variance.
double level_of(const LightPicture& picture, double variance);

/// The grating's shaded_pattern(), blurred as little as the texels can show. `size`: of the finest level, ≥ 16.
PatternPicture pattern_picture(const Grating& grating, const colour::LightSpectra& spectra,
                               int size = kPatternPictureSize);

/// The half-width of a picture: twice the pattern's, so that little of it is blurred over the border, but at most 2.
double picture_half_width(const Grating& grating, const colour::LightSpectra& spectra);

/// The pattern under light of one colour, `flux` (linear RGB), blurred by `variance` or by the least that the texels
/// can show. The second level has twice the variance, or the least that its texels can show. `size` ≥ 16.
LightPicture light_picture(const DiffractionPattern& pattern, double half_width, const glm::vec3& flux, double variance,
                           int size);

}  // namespace rowland::diffraction

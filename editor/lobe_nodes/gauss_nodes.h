#pragma once

#include <array>
#include <cstddef>

#include "engine/lighting/lobe_nodes.h"

namespace rowland::lighting {

/// Monic polynomials in cos^0.7 of the angle of incidence on a microfacet, orthogonal over the lobe of one view:
/// p_{k+1} = (x − mean_k) p_k − ratio_k p_{k−1}.
struct LobePolynomials {
    std::array<double, kLobeNodes> mean{};
    std::array<double, kLobeNodes> ratio{};
    std::array<double, kLobeNodes> norm{};  ///< Σ weight p_k²

    /// p_0 to p_degree.
    std::array<double, kLobeNodes + 1> values(double x, int degree) const {
        std::array<double, kLobeNodes + 1> p{1.0};
        for (std::size_t k = 0; k < static_cast<std::size_t>(degree); ++k)
            p.at(k + 1) = (x - mean.at(k)) * p.at(k) - (k > 0 ? ratio.at(k) * p.at(k - 1) : 0.0);
        return p;
    }

    /// Range of x over the microfacets.
    double least = 0.0;
    double greatest = 0.0;
};

/// x = cos^0.7.
double lobe_coordinate(double cosine);

/// The polynomials of the lobe of one view. `roughness`: perceptual; at least kNarrowestRoughness is used.
LobePolynomials lobe_polynomials(double view_cosine, double roughness);

/// Angles and weights of Gauss's rule over a lobe, exact for polynomials of degree 7 in cos^0.7. `lean` and `roughness`
/// are those of one look-up along the mirror direction.
LobeNodes gauss_nodes(double view_cosine, double roughness);

// Texels of a LobeNodeTable.

/// View of a column: the inverse of lobe_column().
double column_view_cosine(int column);
/// Roughness of a row, at least kNarrowestRoughness.
double row_roughness(int row);
/// Narrower lobes differ only in width, in proportion to roughness².
inline constexpr double kNarrowestRoughness = 0.04;

LobeNodes texel_nodes(const LobeNodeTable& table, int column, int row);
void set_texel(LobeNodeTable& table, int column, int row, const LobeNodes& nodes);

}  // namespace rowland::lighting

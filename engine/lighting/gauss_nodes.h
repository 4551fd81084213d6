#pragma once

#include <array>
#include <cstddef>

#include "engine/lighting/lobe_nodes.h"

namespace rowland::lighting {

/// Polynomials in cos^0.7 of a microfacet's angle that are orthogonal over a view's lobe, monic:
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

    /// Of the microfacets' x.
    double least = 0.0;
    double greatest = 0.0;
};

/// x of an angle.
double lobe_coordinate(double cosine);

/// `roughness`: perceptual.
LobePolynomials lobe_polynomials(double view_cosine, double roughness);

/// Gauss's angles and weights for means over a lobe: exact for polynomials of degree 7 in cos^0.7. `lean` and
/// `roughness` are those of the mirror.
LobeNodes gauss_nodes(double view_cosine, double roughness);

}  // namespace rowland::lighting

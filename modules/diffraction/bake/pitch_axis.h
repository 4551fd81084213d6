#pragma once

#include <cmath>
#include <glm/vec2.hpp>

namespace rowland::diffraction {

/// Pitches that vary over the surface: factors of the material's pitch, at equal steps of their logarithm.
struct PitchAxis {
    double smallest = 0.5;  ///< > 0
    double largest = 2.0;   ///< > smallest
    int nodes = 32;         ///< ≥ 2

    double factor_at(int node) const {
        return smallest * std::pow(largest / smallest, static_cast<double>(node) / (nodes - 1));
    }
    /// 0 at the smallest, 1 at the largest.
    double position_of(double factor) const { return std::log(factor / smallest) / std::log(largest / smallest); }
    /// Scale and offset from a factor's logarithm to the coordinate of a texture of so many texels.
    glm::dvec2 scale_bias() const {
        const double scale = (nodes - 1.0) / nodes / std::log(largest / smallest);
        return {scale, 0.5 / nodes - scale * std::log(smallest)};
    }

    friend bool operator==(const PitchAxis&, const PitchAxis&) = default;
};

}  // namespace rowland::diffraction

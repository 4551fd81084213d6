#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/cube_tree.h"
#include "engine/lighting/key_lights.h"

namespace rowland::lighting {

/// A lobe of flux 1.
struct LobeShape {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
    double concentration = 100.0;
};

/// Inner product of two lobes of flux 1, over the cosine between them, as KeyLightFit says: smoothed, weighted by band,
/// and without the exact bands. Variances of narrow lobes add; the error is of order 1/κ².
class LobeProduct {
 public:
    /// `variance`: the sum of both lobes' 1/κ.
    LobeProduct(double variance, const KeyLightFit& settings);

    double operator()(double cosine) const;

    /// Σ peak exp(concentration (cosine − 1)) − Σ_l band_factor Σ_m Y_lm Y_lm is the product.
    struct Scale {
        double concentration = 0.0;
        double peak = 0.0;
    };
    const std::vector<Scale>& scales() const { return scales_; }
    const std::vector<double>& band_factors() const { return band_factors_; }

 private:
    std::vector<Scale> scales_;
    std::vector<double> band_factors_;
};

/// LobeProduct of two lobes.
double inner_product(const LobeShape& a, const LobeShape& b, const KeyLightFit& settings);

/// A probe that is compared with lobes. Light near a lobe is summed in small nodes of a tree, light far off in large
/// ones.
class MeasuredProbe {
 public:
    MeasuredProbe(CubeTree tree, const KeyLightFit& settings);

    const CubeTree& tree() const { return tree_; }
    const KeyLightFit& settings() const { return settings_; }

    /// Inner product of the probe and a lobe, by channel.
    glm::dvec3 with(const LobeShape& lobe) const;

 private:
    struct Query;
    void add_node(const Query& query, int depth, int face, int column, int row, glm::dvec3& sum) const;

    CubeTree tree_;
    KeyLightFit settings_;
    std::vector<glm::dvec3> low_;  ///< SH of the probe in the exact bands
};

}  // namespace rowland::lighting

#pragma once

#include <Eigen/Core>
#include <array>
#include <glm/vec3.hpp>
#include <span>

#include "engine/lighting/cube_tree.h"
#include "engine/lighting/direction_weight.h"
#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"

namespace rowland::lighting {

/// A lobe of flux 1.
struct LobeShape {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
    double concentration = 100.0;
};

/// Inner product of two lobes of flux 1 over the cosine between them, as KeyLightFit says: smoothed and weighted by
/// band, all bands, equal weights of all directions. Variances of narrow lobes add; the error is of order 1/κ².
class LobeProduct {
 public:
    /// `variance`: the sum of both lobes' 1/κ.
    LobeProduct(double variance, const KeyLightFit& settings);

    double operator()(double cosine) const;

    /// Σ peak exp(concentration (cosine − 1)) is the product.
    struct Scale {
        double concentration = 0.0;
        double peak = 0.0;
    };
    static constexpr int kScales = 4;
    const std::array<Scale, kScales>& scales() const { return scales_; }

 private:
    std::array<Scale, kScales> scales_;
};

/// A lobe as the metric sees it.
struct MeasuredLobe {
    LobeShape shape;
    double root = 1.0;      ///< DirectionWeight::root()
    Eigen::VectorXd bands;  ///< of the weighted light, the low bands
    Eigen::VectorXd error;  ///< the same of the weighted error: without what the exact bands show
};

/// Compares a probe with lobes. What counts is the error that the exact bands leave, light − SH(light), times the
/// DirectionWeight's root: where SH(light) of a lamp shows far from the lamp, it counts as what is seen there. Light
/// near a lobe is summed in small nodes of a tree, light far off in large ones.
class MeasuredProbe {
 public:
    /// `cells`: of gather_cells() with `face_size`.
    MeasuredProbe(std::span<const CubeCell> cells, int face_size, const KeyLightFit& settings);

    /// The light times the weight's root.
    const CubeTree& tree() const { return tree_; }
    const KeyLightFit& settings() const { return settings_; }
    const DirectionWeight& weight() const { return weight_; }

    MeasuredLobe measure(const LobeShape& lobe) const;
    /// Inner product of the probe and a lobe, by channel.
    glm::dvec3 with(const MeasuredLobe& lobe) const;

 private:
    MeasuredProbe(std::span<const CubeCell> cells, int face_size, const CubeTree& light, const KeyLightFit& settings);
    void add_low_bands(const CubeTree& light);

    KeyLightFit settings_;
    int low_bands_;
    DirectionWeight weight_;
    CubeTree tree_;
    Eigen::VectorXd band_roots_;  ///< square root of each coefficient's weight
    Eigen::MatrixXd shown_;       ///< from SH in the exact bands to their weighted light in the low bands
    Eigen::MatrixX3d bands_;      ///< of the probe, as MeasuredLobe's
    Eigen::MatrixX3d error_;
};

/// Inner product of two lobes; `product` is for the sum of their variances.
double inner_product(const MeasuredLobe& a, const MeasuredLobe& b, const LobeProduct& product);

}  // namespace rowland::lighting

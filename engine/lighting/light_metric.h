#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/key_lights.h"
#include "engine/lighting/light_samples.h"

namespace rowland::lighting {

/// The light of a cube map as a quadtree on each face. A sum over any cut through the tree counts each texel once, so
/// it has neither gaps nor noise, however few and bright the lamps.
class CubeTree {
 public:
    struct Node {
        glm::vec3 flux{0.0f};    ///< radiance · solid angle of all its texels
        float solid_angle = 0;   ///< steradians
        glm::vec3 source{0.0f};  ///< unit vector to the light's centroid, by luminance
        float size = 0;          ///< side as an angle, about: √solid_angle
        glm::vec3 centre{0.0f};  ///< unit vector to the centroid of its solid angle
    };

    /// `texels`: 6·face_size² of radiance in CubeLayout's order; face_size a power of two ≥ 4.
    CubeTree(std::span<const glm::vec3> texels, int face_size);
    /// The same for light in the cells of bin_into_cells(): a leaf's source is its cell's weighted mean direction.
    CubeTree(std::span<const CubeCell> cells, int face_size);

    /// Depth of the leaves, which are the texels. The roots, at depth 0, are 4 × 4 parts of each face.
    int leaf_depth() const { return static_cast<int>(levels_.size()) - 1; }
    /// Nodes per side of a face.
    int side(int depth) const { return kRootSide << depth; }
    const Node& node(int depth, int face, int column, int row) const {
        const auto n = static_cast<std::size_t>(side(depth));
        return levels_[static_cast<std::size_t>(depth)]
                      [(static_cast<std::size_t>(face) * n + static_cast<std::size_t>(row)) * n +
                       static_cast<std::size_t>(column)];
    }

    static constexpr int kRootSide = 4;

 private:
    void join_levels(std::vector<Node> leaves, int face_size);

    std::vector<std::vector<Node>> levels_;  ///< by depth; faces, rows, columns
};

/// Weight of an error of a probe's light from direction s: the mean over surface normals n of max(0, n·s)²/S²(n), where
/// S²(n) is the squared signal that such a surface receives. Errors are relative to the other light on a surface: dim
/// light counts where the lamps are below the horizon. A normal has weight (1 + n_y)²/4: surfaces face up more often
/// than down.
class DirectionWeight {
 public:
    /// Light from one direction. Its squared signal on a surface is max(0, n·direction)² times `square`.
    struct Signal {
        glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
        double square = 0.0;
    };
    explicit DirectionWeight(std::span<const Signal> signals);

    /// Square root of the weight, continuous; its mean over the sphere is about 1.
    double root(const glm::dvec3& direction) const;

 private:
    std::vector<double> roots_;  ///< at the corners of cells: faces, rows, columns
};

/// A lobe of flux 1.
struct LobeShape {
    glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
    double concentration = 100.0;
};

/// Inner product of two lobes of flux 1 as a function of the cosine between them, under KeyLightFit's smoothing and
/// band weights, with equal weights of all directions. Variances of narrow lobes add; the error is of order 1/κ².
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
    Eigen::VectorXd bands;  ///< weighted light in the low bands
    Eigen::VectorXd error;  ///< weighted error (light − SH of the exact bands) in the low bands
};

/// Compares a probe with lobes under KeyLightFit's objective: the error, light − SH(light) in the exact bands, is
/// multiplied by DirectionWeight::root(). So ringing of SH(light) far from a lamp is weighted by the light seen there.
/// Light near a lobe is summed in small nodes of a tree, distant light in large ones.
class MeasuredProbe {
 public:
    /// `cells`: bin_into_cells() with `face_size`.
    MeasuredProbe(std::span<const CubeCell> cells, int face_size, const KeyLightFit& settings);

    /// The light times weight().root().
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
    Eigen::VectorXd band_roots_;  ///< square roots of the coefficients' weights
    Eigen::MatrixXd shown_;       ///< maps SH in the exact bands to its weighted light in the low bands
    Eigen::MatrixX3d bands_;      ///< MeasuredLobe's quantities for the probe
    Eigen::MatrixX3d error_;
};

/// Inner product of two lobes; `product` is for the sum of their variances.
double inner_product(const MeasuredLobe& a, const MeasuredLobe& b, const LobeProduct& product);

}  // namespace rowland::lighting

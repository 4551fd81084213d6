#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

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
    /// The same of light that was gathered in cells: a leaf's source is its cell's weighted mean direction.
    CubeTree(std::span<const CubeCell> cells, int face_size);

    /// Depth of the leaves, whose nodes are the texels; the roots (depth 0) are faces cut in 4 × 4.
    int leaf_depth() const { return static_cast<int>(levels_.size()) - 1; }
    /// Nodes a side of a face.
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

}  // namespace rowland::lighting

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "engine/lighting/sh_light.h"
#include "engine/math/frame_rotation.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/representations/arc/arc_table.h"

namespace rowland::diffraction {

/// The vertices' part of an arc table, for many vertices: light_products() in every vertex's tangent frame.
class ArcProducts {
 public:
    /// `xyz_to_space`: to the colour space of the products.
    ArcProducts(const ArcTable& table, const glm::dmat3& xyz_to_space);

    int bands() const { return projection_.bands(); }
    /// ⌈rank/4⌉.
    int layers() const { return layers_; }

    /// For each vertex 3·layers() vectors: the colours' components of p_4j … p_4j+3, by j. `light` has bands().
    /// Multithreaded.
    std::vector<glm::vec4> operator()(const lighting::ShLight& light, const scene::Mesh& mesh,
                                      const glm::mat4& object_to_world, double groove_rotation) const;

 private:
    int layers_;
    math::FrameProjection projection_;  ///< from SH to the table's light terms
    std::vector<glm::vec4> factors_;    ///< for each term and colour, the vectors to add
};

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

#include "engine/lighting/sh_light.h"
#include "engine/math/frame_rotation.h"
#include "engine/scene/mesh.h"
#include "modules/diffraction/representations/representation.h"

namespace rowland::diffraction {

/// The tangent frame (g, h, n) of a vertex in world space, as rows. `groove_rotation` (radians) turns g from the mesh's
/// tangent toward its bitangent, whose sign is the tangent's w.
glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec3& tangent, const glm::mat4& object_to_world);
glm::dmat3 tangent_frame(const glm::vec3& normal, const glm::vec4& tangent, const glm::mat4& object_to_world,
                         double groove_rotation);

/// Step 1 of Lindsay & Agu 2006, fig. 5: the light's SH in every vertex's tangent frame. Returns vertices ×
/// bands² × 3 floats (RGB innermost). Multithreaded.
std::vector<float> rotate_to_vertices(const lighting::ShLight& light, const scene::Mesh& mesh,
                                      const glm::mat4& object_to_world, double groove_rotation = 0.0);

/// The same, multiplied by a constant matrix: vertices × projection.rows() × 3 floats. The light has the projection's
/// bands.
std::vector<float> project_to_vertices(const lighting::ShLight& light, const math::FrameProjection& projection,
                                       const scene::Mesh& mesh, const glm::mat4& object_to_world,
                                       double groove_rotation = 0.0);

/// Largest angle in radians between a flat mesh's normals and their mean: not visible at a map's resolution.
inline constexpr double kFlatness = 0.005;

/// The mesh's normal in object axes, if all its normals agree.
std::optional<glm::dvec3> flat_normal(const scene::Mesh& mesh);

/// The tangent of a flat mesh with its bitangent's sign, in object axes, if all its tangents agree.
std::optional<glm::vec4> common_tangent(const scene::Mesh& mesh);

/// The layout of the grooves of an object with that mesh. A skinned one counts as curved, since its skin may bend it.
GrooveLayout groove_layout(const scene::Mesh& mesh, bool skinned, bool has_groove_texture);
/// The representation that draws an object of this layout: that of the tables or, where they need a flat surface and
/// the object is curved, that of their stand-in.
const RepresentationInfo& drawn_info(const BakedTables& tables, GrooveLayout layout);

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

/// The products of an arc table for every grating vector of one plane. n-band light rotated about the normal is a
/// Fourier series up to n−1 in the azimuth of g, and so are the products.
struct ArcTurns {
    glm::dvec3 e1{1.0, 0.0, 0.0};  ///< azimuth 0 and 90° of g, world axes
    glm::dvec3 e2{0.0, 1.0, 0.0};
    /// The constant, then cos and sin of each multiple, 2n−1 in all; each has the 3·layers() vectors of ArcProducts.
    std::vector<glm::vec4> terms;
};

/// `normal`: unit, in the world. `light` has products.bands().
ArcTurns arc_turns(const ArcProducts& products, const lighting::ShLight& light, const glm::dvec3& normal);

}  // namespace rowland::diffraction

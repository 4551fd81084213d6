#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/light_probe.h"
#include "engine/scene/camera.h"
#include "engine/scene/mesh.h"
#include "engine/scene/transform.h"

namespace rowland::diffraction {

/// One triangle whose vertices have different tangent frames, one of a mirrored bitangent.
scene::Mesh crooked_triangle();

/// The same in one plane, with its normal and different grating vectors.
scene::Mesh flat_triangle();

/// What the CPU shades: a point of a triangle.
struct Point {
    glm::dvec3 weights{0.0};  ///< barycentric
    glm::dvec3 position{0.0};
    glm::dmat3 to_tangent{1.0};  ///< rows g, h, n: the vertices', interpolated and made orthonormal
    glm::dvec3 view{0.0};        ///< toward the eye, in (g, h, n)
    /// What the pixels of the next column and the next row have more of, up to a common sign.
    struct Change {
        glm::dvec3 g{0.0};
        glm::dvec3 h{0.0};
        glm::dvec2 view{0.0};  ///< (v_g, v_h)
        glm::dvec3 position{0.0};
    };
    Change beside;
    Change below;
};

/// Half the width of an interval of u = s_g + v_g with its variance over the pixel, for a light in the direction
/// `toward` (world): PHYSICS (11.1).
double footprint(const Point& point, const glm::dvec3& toward);
/// The same for a light at a point.
double footprint_of_lamp(const Point& point, const glm::dvec3& lamp);

/// A triangle as the CPU sees it in a square picture.
class DrawnTriangle {
 public:
    static constexpr int kSize = 64;  ///< of the picture, in pixels

    DrawnTriangle();

    /// Tangent frame of a vertex, rows g, h, n.
    glm::dmat3 vertex_frame(std::size_t vertex) const;
    /// `light`, so many bands of it, rotated into a vertex's frame.
    lighting::ShLight vertex_light(std::size_t vertex, const lighting::ShLight& light, int bands) const;
    /// Toward the eye, in a vertex's frame.
    glm::dvec3 vertex_view(std::size_t vertex) const;
    /// The triangle's plane at a pixel's centre.
    Point point_at(int column, int row) const;
    /// Interpolates what a vertex shader computes.
    static glm::dvec3 mix(const Point& point, const std::vector<glm::dvec3>& vertices);

 protected:
    scene::Mesh mesh_ = crooked_triangle();
    scene::Transform transform_;
    scene::Camera camera_;
    double rotation_ = 0.0;  ///< of the grooves

 private:
    /// A point without its neighbours.
    Point single_point_at(int column, int row) const;
};

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace rowland::diffraction {

/// A shaded point in world axes: the direction to the eye, the surface normal, and the grating vector (across the
/// grooves).
struct ShadingPoint {
    glm::dvec3 view{0.0, 0.0, 1.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};
    glm::dvec3 grating{1.0, 0.0, 0.0};

    friend bool operator==(const ShadingPoint&, const ShadingPoint&) = default;
};

/// True if all three vectors are finite and not 0, and the grating vector is not along the normal.
bool is_valid(const ShadingPoint& frame);

/// The rotation from world to tangent frame: rows g, h = n × g, n, g made orthogonal to n (PHYSICS §1). The frame must
/// be valid.
glm::dmat3 world_to_tangent(const ShadingPoint& frame);

}  // namespace rowland::diffraction

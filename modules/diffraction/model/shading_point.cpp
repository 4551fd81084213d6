#include "modules/diffraction/model/shading_point.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "engine/core/check.h"

namespace rowland::diffraction {

namespace {

/// Finite, and long enough to have a direction.
bool has_direction(const glm::dvec3& v) {
    const double length = glm::length(v);
    return std::isfinite(length) && length > 1e-12;
}

}  // namespace

bool is_valid(const ShadingPoint& frame) {
    if (!has_direction(frame.view) || !has_direction(frame.normal) || !has_direction(frame.grating)) return false;
    return has_direction(glm::cross(glm::normalize(frame.normal), glm::normalize(frame.grating)));
}

glm::dmat3 world_to_tangent(const ShadingPoint& frame) {
    ROWLAND_CHECK(is_valid(frame), "a frame needs three directions, the grating vector not along the normal");
    const glm::dvec3 n = glm::normalize(frame.normal);
    const glm::dvec3 h = glm::normalize(glm::cross(n, glm::normalize(frame.grating)));
    const glm::dvec3 g = glm::cross(h, n);
    return glm::transpose(glm::dmat3(g, h, n));
}

}  // namespace rowland::diffraction

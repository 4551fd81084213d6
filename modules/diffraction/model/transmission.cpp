#include "modules/diffraction/model/transmission.h"

#include <glm/geometric.hpp>

namespace rowland::diffraction {

ShadingPoint lit_from_behind(const ShadingPoint& frame) {
    const glm::dvec3 n = glm::normalize(frame.normal);
    return {.view = frame.view - 2.0 * glm::dot(frame.view, n) * n, .normal = -n, .grating = frame.grating};
}

}  // namespace rowland::diffraction

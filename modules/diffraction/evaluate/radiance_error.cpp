#include "modules/diffraction/evaluate/radiance_error.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "engine/core/check.h"

namespace rowland::diffraction {

double relative_rms(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    ROWLAND_CHECK(radiance.size() == reference.size(), "one value per frame in both");
    double difference = 0.0;
    double scale = 0.0;
    for (std::size_t i = 0; i < radiance.size(); ++i) {
        const glm::dvec3 error = radiance[i] - reference[i];
        difference += glm::dot(error, error);
        scale += glm::dot(reference[i], reference[i]);
    }
    if (difference == 0.0) return 0.0;
    return scale > 0.0 ? std::sqrt(difference / scale) : std::numeric_limits<double>::infinity();
}

}  // namespace rowland::diffraction

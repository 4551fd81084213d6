#include "modules/diffraction/evaluate/error_measure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/common.hpp>
#include <glm/matrix.hpp>
#include <utility>

#include "engine/colour/delta_e.h"
#include "engine/colour/working_space.h"
#include "engine/core/check.h"
#include "modules/diffraction/evaluate/frame_sets.h"
#include "modules/diffraction/evaluate/measured_picture.h"
#include "modules/diffraction/evaluate/radiance_error.h"

namespace rowland::diffraction {

namespace {

constexpr double kMiddleGrey = 0.18;
constexpr double kSeenFraction = 0.95;

/// CIEDE2000 that 95 % of the points do not exceed, both exposed for the reference and clipped to Rec. 709.
double high_delta_e(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference) {
    ROWLAND_CHECK_OP(radiance.size(), ==, reference.size());
    const glm::dmat3 to_xyz = colour::rec709_to_xyz();
    const glm::dmat3 to_rgb = std::exp2(double{exposure_for(reference)}) * glm::inverse(to_xyz);
    const auto lab = [&](const glm::dvec3& xyz) {
        return colour::xyz_to_lab(to_xyz * glm::clamp(to_rgb * xyz, 0.0, 1.0), colour::white_d65());
    };
    std::vector<double> differences;
    for (std::size_t i = 0; i < reference.size(); ++i)
        differences.push_back(colour::delta_e_2000(lab(radiance[i]), lab(reference[i])));
    return quantile(std::move(differences), kSeenFraction);
}

}  // namespace

std::vector<ShadingPoint> measured_points(ErrorMeasure measure, SurfaceShape surface) {
    return measure == ErrorMeasure::HdrFlip ? measured_picture(surface).points : measured_frames(surface);
}

ErrorFunction error_function(ErrorMeasure measure, SurfaceShape surface) {
    if (measure == ErrorMeasure::DeltaE) return high_delta_e;
    if (measure == ErrorMeasure::RelativeRms) return relative_rms;
    return [layout = measured_picture(surface).layout](std::span<const glm::dvec3> radiance,
                                                       std::span<const glm::dvec3> reference) {
        return mean_hdr_flip(layout, radiance, reference);
    };
}

float exposure_for(std::span<const glm::dvec3> xyz) {
    double sum = 0.0;
    int lit = 0;
    for (const glm::dvec3& value : xyz)
        if (value.y > 0.0) {
            sum += value.y;
            ++lit;
        }
    return lit == 0 ? 0.0F : static_cast<float>(std::log2(kMiddleGrey * lit / sum));
}

double quantile(std::vector<double> values, double fraction) {
    if (values.empty()) return 0.0;
    const auto count = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(values.size())));
    const std::size_t index = std::clamp<std::size_t>(count, 1, values.size()) - 1;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(index), values.end());
    return values[index];
}

}  // namespace rowland::diffraction

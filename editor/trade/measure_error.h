#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "editor/trade/frame_sets.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::trade {

/// XYZ of all points of a set as the cooked material's shaders give them. Flat surfaces have their map where a
/// representation has one, curved ones what stands in for it.
std::vector<glm::dvec3> shaded(const diffraction::CookedMaterial& cooked, const diffraction::EvaluationLight& light,
                               const FrameSet& set);

/// How far one method is from another over the same points.
struct MethodError {
    double relative_rms = 0.0;    ///< PHYSICS §1
    double largest = 0.0;         ///< largest ‖ΔXYZ‖ over the largest ‖XYZ‖ of the reference
    double dark_absolute = 0.0;   ///< mean |ΔY| over dark points over the mean Y of all: see kDark. 0 if none is dark
    double median_delta_e = 0.0;  ///< CIEDE2000 on the display, both exposed as the reference asks for
    double high_delta_e = 0.0;    ///< of 95 % of the points at most this
};

/// Points whose Y in the reference is below this share of its mean are dark.
inline constexpr double kDark = 0.2;

/// The spans are of one length, one value per point.
MethodError compare(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference);

/// Display values (sRGB, encoded, held within 0 to 1) of XYZ under the shipped colour configuration.
std::vector<glm::vec3> displayed(std::span<const glm::dvec3> xyz, float exposure_stops);

/// Stops that bring the mean Y of what is not black to 0.18.
float exposure_for(std::span<const glm::dvec3> xyz);

/// CIEDE2000 of display values, as pairs.
std::vector<double> display_differences(std::span<const glm::vec3> a, std::span<const glm::vec3> b);

}  // namespace rowland::trade

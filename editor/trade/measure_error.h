#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "editor/trade/frame_sets.h"
#include "editor/trade/picture_scene.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/evaluation_light.h"

namespace rowland::trade {

/// diffraction::shade_surfaces() of a set.
inline std::vector<glm::dvec3> shaded(const diffraction::CookedMaterial& cooked,
                                      const diffraction::EvaluationLight& light, const FrameSet& set) {
    return shade_surfaces(cooked, light, set.surfaces);
}

/// The difference of one method from another over the same points.
struct MethodError {
    double relative_rms = 0.0;     ///< PHYSICS §1
    double largest = 0.0;          ///< largest ‖ΔXYZ‖ over the largest ‖XYZ‖ of the reference
    double dark_absolute = 0.0;    ///< mean |ΔY| of the dark points over the mean Y of all; 0 if no point is dark
    double median_delta_e = 0.0;   ///< CIEDE2000 on the display, both exposed for the reference
    double high_delta_e = 0.0;     ///< its 95th percentile
    std::optional<double> flip{};  ///< of pictures: mean_hdr_flip()
};

/// The names of the quantities in tables.
inline constexpr std::array<std::pair<const char*, double MethodError::*>, 5> kErrorQuantities = {
    {{"relative_rms", &MethodError::relative_rms},
     {"largest", &MethodError::largest},
     {"dark_absolute", &MethodError::dark_absolute},
     {"median_delta_e", &MethodError::median_delta_e},
     {"p95_delta_e", &MethodError::high_delta_e}}};

/// A point is dark if its Y in the reference is below this fraction of the mean Y.
inline constexpr double kDark = 0.2;

/// The spans are of one length, one value per point.
MethodError compare(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference);

/// The same of a picture, with "flip".
MethodError compare_pictures(const PictureFrames& frames, std::span<const glm::dvec3> radiance,
                             std::span<const glm::dvec3> reference);

/// Display values (sRGB, encoded, clamped to [0, 1]) of XYZ under the shipped colour configuration.
std::vector<glm::vec3> displayed(std::span<const glm::dvec3> xyz, float exposure_stops);

/// CIEDE2000 between the display values of each pair.
std::vector<double> display_differences(std::span<const glm::vec3> a, std::span<const glm::vec3> b);

}  // namespace rowland::trade

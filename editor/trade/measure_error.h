#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "editor/trade/inputs.h"
#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/representations/point_shader.h"

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
    double median_delta_e = 0.0;   ///< CIEDE2000 of display values, both exposed for the reference
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

/// The error of `radiance` against `reference`: XYZ of the same points, so of equal length.
MethodError compare(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference);

/// compare() of a picture, with "flip".
MethodError compare_pictures(const PictureFrames& frames, std::span<const glm::dvec3> radiance,
                             std::span<const glm::dvec3> reference);

/// Display values (sRGB, encoded, clamped to [0, 1]) of XYZ under the shipped colour configuration.
std::vector<glm::vec3> displayed(std::span<const glm::dvec3> xyz, float exposure_stops);

/// CIEDE2000 between the display values of each pair.
std::vector<double> display_differences(std::span<const glm::vec3> a, std::span<const glm::vec3> b);

/// 8-bit RGB, rows from the top.
struct RgbPicture {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;
};

/// The picture as a PNG in a data URL.
std::string data_url(const RgbPicture& picture);

/// ΔE2000 at the end of the colour scale.
inline constexpr double kFullDifference = 20.0;

/// Two pictures of XYZ on the display, both exposed for the second, and their difference, side by side: ΔE2000 from
/// black (0) over violet and green to yellow (kFullDifference or more). Each pixel is magnified by `magnified`.
RgbPicture difference_image(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b, int width, int height,
                            int magnified);

/// The colour scale at a fraction of kFullDifference, 0 to 1.
glm::vec3 difference_colour(double fraction);

}  // namespace rowland::trade

#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace rowland::post {

/// Exposure that follows the picture: its log-average luminance is shown as mid-grey (Reinhard et al. 2002, eqs. 1-2).
struct AutoExposureSettings {
    float key = 0.18F;      ///< scene-linear luminance the average is exposed to; above 0
    float darkest = 1e-4F;  ///< what is darker counts as this, so that black does not drown the rest; above 0
    float min_stops = -8.0F;
    float max_stops = 8.0F;  ///< at least min_stops
    /// How fast stops rise (the eye getting used to the dark) and fall, 1/s: what is missing shrinks as exp(-speed·t).
    float speed_up = 1.5F;
    float speed_down = 4.0F;
};

/// The mean of log2(max(luminance, darkest)), luminance = weights · pixel, over the pixels where that is finite;
/// nothing if there are none. `weights` is the Y row of the working space's matrix to XYZ. The twin of
/// AutoExposurePass.
std::optional<double> mean_log2_luminance(std::span<const glm::vec3> pixels, const glm::vec3& weights, float darkest);

/// log2(key) - mean_log2, held within [min_stops, max_stops].
float target_stops(double mean_log2, const AutoExposureSettings& settings);

/// Where stops have got to on their way to the target after so many seconds, at least 0. Steps add up: it makes no
/// difference in how many frames the time passes.
float adapted_stops(float stops, float target, float seconds, const AutoExposureSettings& settings);

/// A logic error if a setting is out of range.
void require_valid(const AutoExposureSettings& settings);

}  // namespace rowland::post

#include "engine/post/auto_exposure.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/core/check.h"

namespace rowland::post {

std::optional<double> mean_log2_luminance(std::span<const glm::vec3> pixels, const glm::vec3& weights, float darkest) {
    double sum = 0.0;
    double count = 0.0;
    for (const glm::vec3& pixel : pixels) {
        const float luminance = glm::dot(weights, pixel);
        if (!std::isfinite(luminance)) continue;
        sum += std::log2(static_cast<double>(std::max(luminance, darkest)));
        count += 1.0;
    }
    if (count == 0.0) return std::nullopt;
    return sum / count;
}

float target_stops(double mean_log2, const AutoExposureSettings& settings) {
    const double stops = std::log2(static_cast<double>(settings.key)) - mean_log2;
    return std::clamp(static_cast<float>(stops), settings.min_stops, settings.max_stops);
}

float adapted_stops(float stops, float target, float seconds, const AutoExposureSettings& settings) {
    ROWLAND_CHECK_OP(seconds, >=, 0.0F);
    const float speed = target > stops ? settings.speed_up : settings.speed_down;
    return stops - (target - stops) * std::expm1(-speed * seconds);
}

void require_valid(const AutoExposureSettings& settings) {
    ROWLAND_CHECK_OP(settings.key, >, 0.0F);
    ROWLAND_CHECK_OP(settings.darkest, >, 0.0F);
    ROWLAND_CHECK_OP(settings.min_stops, <=, settings.max_stops);
    ROWLAND_CHECK_OP(settings.speed_up, >=, 0.0F);
    ROWLAND_CHECK_OP(settings.speed_down, >=, 0.0F);
}

}  // namespace rowland::post

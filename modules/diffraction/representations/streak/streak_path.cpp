#include "modules/diffraction/representations/streak/streak_path.h"

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>

namespace rowland::diffraction {

namespace {

constexpr double kLeastExtent = 1e-6;

}  // namespace

StreakPath::StreakPath(double low, double high, const LobePoint& before, const LobePoint& centre,
                       const LobePoint& after)
    : middle_(0.5 * (low + high)), scale_(2.0 / std::max(high - low, kLeastExtent)), level_(centre.level) {
    const int chart = centre.direction.y < 0.0 ? 1 : 0;
    const auto texture = [chart](const LobePoint& point) {
        return streak_position(point.direction, point.along, chart).texture;
    };
    const glm::dvec3 first = texture(before);
    glm::dvec3 last = texture(after);
    last.z -= std::round(last.z - first.z);
    mean_ = 0.5 * (last + first);
    slope_ = 0.5 * (last - first);
    bend_ = glm::dvec3(glm::dvec2(mean_ - texture(centre)), 0.0);
}

StreakPosition StreakPath::at(double x) const {
    const double t = scale_ * (x - middle_);
    return {mean_ + t * slope_ + (t * t - 1.0) * bend_, level_};
}

}  // namespace rowland::diffraction

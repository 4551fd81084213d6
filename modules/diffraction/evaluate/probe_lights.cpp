#include "modules/diffraction/evaluate/probe_lights.h"

namespace rowland::diffraction {

const EvaluationLight& ProbeLights::split(int key_lights, math::SphericalWindow window) {
    const std::pair key(key_lights, window);
    const auto found = splits_.find(key);
    if (found != splits_.end()) return found->second;
    if (!projected_) projected_ = bands_ > 0 ? lighting::project(*image_, bands_) : lighting::ShLight();
    return splits_.emplace(key, EvaluationLight(*image_, key_lights, window, *projected_)).first->second;
}

}  // namespace rowland::diffraction

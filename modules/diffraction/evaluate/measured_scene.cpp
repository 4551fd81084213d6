#include "modules/diffraction/evaluate/measured_scene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>
#include <variant>

#include "engine/core/progress.h"
#include "modules/diffraction/evaluate/point_shader.h"

namespace rowland::diffraction {

bool is_flat(const Surface& surface) {
    constexpr double kSameNormal = 1.0 - 1e-9;
    return std::all_of(surface.begin(), surface.end(), [&](const Frame& frame) {
        return glm::dot(glm::normalize(surface.front().normal), glm::normalize(frame.normal)) > kSameNormal;
    });
}

std::vector<glm::dvec3> shade_surfaces(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const Surface> surfaces) {
    std::vector<glm::dvec3> result;
    for (const Surface& surface : surfaces) {
        CookedMaterial stand_in;
        const auto* planar = std::get_if<PlanarTables>(&cooked.tables);
        const bool use_stand_in = planar != nullptr && !is_flat(surface);
        if (use_stand_in) {
            stand_in = cooked;
            stand_in.tables = planar->stand_in;
        }
        const std::vector<glm::dvec3> part = evaluate_baked(use_stand_in ? stand_in : cooked, light, surface);
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

MeasuredScene::MeasuredScene(std::string name, std::shared_ptr<ProbeLights> lights, std::vector<Surface> surfaces,
                             std::size_t part, Reference reference)
    : name_(std::move(name)),
      lights_(std::move(lights)),
      surfaces_(std::move(surfaces)),
      part_(part),
      compute_(std::move(reference)) {}

bool MeasuredScene::prepare(const std::stop_token& stop) {
    std::vector<Frame> frames;
    for (const Surface& surface : surfaces_) frames.insert(frames.end(), surface.begin(), surface.end());
    if (reference_.size() == frames.size()) return true;
    Progress progress("reference, " + name_, frames.size());
    progress.advance(reference_.size());
    while (reference_.size() < frames.size()) {
        if (stop.stop_requested()) return false;
        const std::size_t known = reference_.size();
        const std::vector<glm::dvec3> part =
            compute_(std::span(frames).subspan(known, std::min(part_, frames.size() - known)));
        reference_.insert(reference_.end(), part.begin(), part.end());
        progress.advance(part.size());
    }
    return true;
}

const std::vector<glm::dvec3>& MeasuredScene::reference() {
    prepare();
    return reference_;
}

std::vector<glm::dvec3> MeasuredScene::shaded(const CookedMaterial& cooked, int key_lights,
                                              math::SphericalWindow window) {
    return shade_surfaces(cooked, lights_->split(key_lights, window), surfaces_);
}

}  // namespace rowland::diffraction

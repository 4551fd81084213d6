#include "modules/diffraction/evaluate/measured_scene.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <memory>
#include <optional>
#include <variant>

#include "engine/core/progress.h"
#include "modules/diffraction/evaluate/point_shader.h"

namespace rowland::diffraction {

namespace {

/// A planar material as curved surfaces show it.
CookedMaterial with_stand_in(const CookedMaterial& cooked) {
    CookedMaterial result = cooked;
    result.tables = *std::get<PlanarTables>(cooked.tables).stand_in;
    if (cooked.reflected) result.reflected = std::make_shared<const CookedMaterial>(with_stand_in(*cooked.reflected));
    return result;
}

}  // namespace

bool is_flat(const Surface& surface) {
    constexpr double kSameNormal = 1.0 - 1e-9;
    return std::all_of(surface.begin(), surface.end(), [&](const ShadingPoint& frame) {
        return glm::dot(glm::normalize(surface.front().normal), glm::normalize(frame.normal)) > kSameNormal;
    });
}

std::vector<glm::dvec3> shade_surfaces(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const Surface> surfaces) {
    std::vector<glm::dvec3> result;
    for (const Surface& surface : surfaces) {
        std::optional<CookedMaterial> stand_in;
        if (std::holds_alternative<PlanarTables>(cooked.tables) && !is_flat(surface)) stand_in = with_stand_in(cooked);
        const std::vector<glm::dvec3> part = evaluate_baked(stand_in ? *stand_in : cooked, light, surface);
        result.insert(result.end(), part.begin(), part.end());
    }
    return result;
}

bool MeasuredScene::prepare(const std::stop_token& stop) {
    std::vector<ShadingPoint> frames;
    for (const Surface& surface : surfaces) frames.insert(frames.end(), surface.begin(), surface.end());
    Progress progress("reference, " + name, frames.size() - reference.size());
    while (reference.size() < frames.size()) {
        if (stop.stop_requested()) return false;
        const std::size_t known = reference.size();
        const auto next = by_reference(std::span(frames).subspan(known, std::min(part, frames.size() - known)));
        reference.insert(reference.end(), next.begin(), next.end());
        progress.advance(next.size());
    }
    return true;
}

}  // namespace rowland::diffraction

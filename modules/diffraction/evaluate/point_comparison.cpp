#include "modules/diffraction/evaluate/point_comparison.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "engine/colour/light_spectra.h"
#include "modules/diffraction/evaluate/radiance_error.h"
#include "modules/diffraction/reference/reference.h"

namespace rowland::diffraction {

PointComparer::PointComparer(lighting::ProbeImage probe, int key_lights)
    : probe_(std::make_unique<const lighting::ProbeImage>(std::move(probe))),
      fitted_(key_lights),
      lights_(*probe_, 0, key_lights) {}

lighting::ShLight PointComparer::harmonics(int key_lights, int bands) {
    return lights_.split(std::min(key_lights, fitted_)).harmonics(bands);
}

PointComparison PointComparer::compare(const std::shared_ptr<const CookedMaterial>& cooked,
                                       math::SphericalWindow window, const ShadingPoint& frame) {
    const EvaluationLight& lit = lights_.split(std::min(cooked->material.quality.key_lights, fitted_), window);
    if (!ready_ || ready_->cooked != cooked || ready_->light != &lit)
        ready_.emplace(Ready{cooked, &lit, baked_shader(*cooked, lit)});
    const std::array points{frame};
    const colour::LightSpectra spectra(cooked->material.quality.illuminant);
    PointComparison result;
    std::vector<glm::dvec3> shown = evaluate_points(info(cooked->tables).name, ready_->shader, *cooked, lit, points);
    add_reflected_side(*cooked, lit, points, shown);
    result.shown = shown[0];
    result.reference = reference_radiance(cooked->material.grating, *probe_, spectra, points)[0];
    result.error = relative_rms(std::span(&result.shown, 1), std::span(&result.reference, 1));
    return result;
}

}  // namespace rowland::diffraction

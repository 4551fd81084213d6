#include "modules/diffraction/runtime/key_lobe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

#include "modules/diffraction/representations/direct/lobe_table.h"

namespace rowland::diffraction {

KeyLobe key_lobe(const lighting::KeyLight& light) {
    const lighting::LobeMoments moments = lighting::lobe_moments(light.concentration);
    const double flux = std::max(glm::compMax(light.flux), 1e-30);
    const double deviation = 1.0 / std::sqrt(light.concentration);
    const double step = ROWLAND_LOBE_WINDOW_STEP * deviation;
    const double last = ROWLAND_LOBE_WINDOWS * step;
    const double elongation = (moments.variance_along - moments.variance_across) / (moments.mean * moments.mean);
    const double reach = 5.2 * std::sqrt(moments.variance_across);
    return {.direction = glm::vec4(glm::dvec4(light.direction, light.concentration)),
            .flux = glm::vec4(glm::dvec4(light.flux, flux)),
            .moments = glm::vec4(glm::dvec4(moments.mean, elongation, moments.variance_across, reach)),
            .turns = glm::vec4(glm::dvec4(std::cos(deviation), std::sin(deviation), std::cos(step), std::sin(step))),
            .mean = glm::vec4(glm::dvec4(moments.mean * light.direction, reach)),
            .variance = glm::vec4(glm::dvec4(12.0 * elongation, 12.0 * (moments.variance_across + kLeastLobeVariance),
                                             std::cos(last), std::sin(last))),
            .height = glm::vec4(lobe_height_fit(light.concentration) + glm::dvec4(std::log2(flux), 0.0, 0.0, 0.0))};
}

bool same_lobes(std::span<const lighting::KeyLight> a, std::span<const lighting::KeyLight> b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const lighting::KeyLight& one, const lighting::KeyLight& other) {
                          return one.flux == other.flux && one.concentration == other.concentration;
                      });
}

}  // namespace rowland::diffraction

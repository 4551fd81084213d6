#include "modules/thin_film/reference/rough_reference.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/core/parallel.h"
#include "modules/thin_film/model/film_colour.h"

namespace rowland::thin_film {

namespace {

constexpr std::size_t kSteps = 1000;

/// D G n·l / (4 n·l n·v).
double lobe(double n_v, double n_l, double n_h, double a2) {
    const double peak = n_h * n_h * (a2 - 1.0) + 1.0;
    const double d = a2 / (std::numbers::pi * peak * peak);
    const double smith = n_v * std::sqrt(n_l * n_l * (1.0 - a2) + a2) + n_l * std::sqrt(n_v * n_v * (1.0 - a2) + a2);
    return d * n_l / (2.0 * smith);
}

}  // namespace

RoughReference::RoughReference(const Film& film, const colour::LightSpectra& spectra) : values_(kSteps + 1) {
    const FilmColour colour(film, spectra);
    parallel_for(values_.size(), [&](std::size_t i) { values_[i] = colour(static_cast<double>(i) / kSteps); });
}

glm::dmat3 RoughReference::at(double cosine) const {
    const double position = std::clamp(cosine, 0.0, 1.0) * kSteps;
    const std::size_t i = std::min(static_cast<std::size_t>(position), kSteps - 1);
    const double t = position - static_cast<double>(i);
    return (1.0 - t) * values_[i] + t * values_[i + 1];
}

RoughReference::Reflected RoughReference::reflected(const lighting::LightSamples& light, const glm::dvec3& n,
                                                    const glm::dvec3& v, double roughness) const {
    const double a2 = std::pow(roughness, 4.0);
    const double n_v = glm::dot(n, v);
    Reflected sum;
    if (n_v <= 0.0) return sum;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 l = light.direction(i);
        const double n_l = glm::dot(n, l);
        if (n_l <= 0.0) continue;
        const glm::dvec3 h = glm::normalize(l + v);
        const glm::dvec3 part = lobe(n_v, n_l, glm::dot(n, h), a2) * light.flux(i);
        sum.without_fresnel += part;
        sum.xyz += at(glm::dot(v, h)) * part;
    }
    return sum;
}

}  // namespace rowland::thin_film

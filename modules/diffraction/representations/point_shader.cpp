#include "modules/diffraction/representations/point_shader.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "engine/math/spherical_harmonics.h"

namespace rowland::diffraction {

namespace {

// Resolution of band-limited light as texels: 32 texels per period at 32 bands, the maximum.
constexpr int kGridWidth = 1024;

lighting::LightSamples texels_of(const lighting::ShLight& light) {
    const int height = kGridWidth / 2;
    const image::Image black{.width = kGridWidth,
                             .height = height,
                             .texels = std::vector<glm::vec3>(static_cast<std::size_t>(kGridWidth * height))};
    const lighting::ProbeImage grid(black, lighting::Mapping::Equirectangular);
    lighting::LightSamples texels;
    std::vector<double> basis(light.coefficients.size());
    for (int row = 0; row < height; ++row)
        for (int column = 0; column < kGridWidth; ++column) {
            const glm::dvec3 direction = grid.direction(column + 0.5, row + 0.5);
            math::evaluate_sh(direction, light.bands, basis);
            glm::dvec3 flux(0.0);
            for (std::size_t i = 0; i < basis.size(); ++i) flux += basis[i] * light.coefficients[i];
            flux *= grid.solid_angle(column, row);
            texels.x.push_back(static_cast<float>(direction.x));
            texels.y.push_back(static_cast<float>(direction.y));
            texels.z.push_back(static_cast<float>(direction.z));
            texels.red.push_back(static_cast<float>(flux.r));
            texels.green.push_back(static_cast<float>(flux.g));
            texels.blue.push_back(static_cast<float>(flux.b));
        }
    return texels;
}

}  // namespace

EvaluationLight::EvaluationLight(lighting::ProbeImage probe, int key_lights, math::SphericalWindow window,
                                 lighting::ShLight projected)
    : probe_(std::move(probe)),
      sh_(std::move(projected)),
      key_lights_(lighting::fit_key_lights(*probe_, key_lights)),
      window_(window) {}

EvaluationLight::EvaluationLight(lighting::ShLight light, math::SphericalWindow window)
    : sh_(std::move(light)), window_(window) {}

EvaluationLight EvaluationLight::with_first(int key_lights) const {
    EvaluationLight light = *this;
    light.key_lights_.resize(std::min(key_lights_.size(), static_cast<std::size_t>(key_lights)));
    return light;
}

lighting::ShLight EvaluationLight::harmonics(int bands) const {
    if (!probe_) return lighting::limit_bands(sh_, std::min(bands, sh_.bands), window_);
    const lighting::ShLight whole = bands <= sh_.bands ? sh_ : lighting::project(*probe_, bands);
    return lighting::limit_bands(lighting::residual(whole, key_lights_, bands), bands, window_);
}

lighting::LightSamples EvaluationLight::texels() const {
    return probe_ ? lighting::light_samples(*probe_, key_lights_) : texels_of(sh_);
}

const EvaluationLight& ProbeLights::split(int key_lights, math::SphericalWindow window) {
    const std::pair key(key_lights, window);
    const auto found = splits_.find(key);
    if (found != splits_.end()) return found->second;
    if (key_lights < fitted_) return splits_.emplace(key, split(fitted_, window).with_first(key_lights)).first->second;
    if (!projected_) projected_ = bands_ > 0 ? lighting::project(*image_, bands_) : lighting::ShLight();
    return splits_.emplace(key, EvaluationLight(*image_, key_lights, window, *projected_)).first->second;
}

PointShader in_tangent_frame(lighting::ShLight light, TangentShader shade) {
    return [light = std::move(light), shade = std::move(shade)](const ShadingPoint& frame) {
        const glm::dmat3 tangent = world_to_tangent(frame);
        const glm::dvec3 view = tangent * glm::normalize(frame.view);
        if (view.z <= 0.0) return glm::dvec3(0.0);
        lighting::ShLight rotated{light.bands, std::vector<glm::dvec3>(light.coefficients.size())};
        math::ShRotation(tangent, light.bands)
            .apply(std::span<const glm::dvec3>(light.coefficients), std::span<glm::dvec3>(rotated.coefficients));
        return shade(rotated, view);
    };
}

}  // namespace rowland::diffraction

#pragma once

#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::trade {

/// Whether a material file holds a film.
bool is_film(const nlohmann::json& material);

/// XYZ of what a film reflects of a probe at each frame. `method`: "reference", every microfacet with its own light and
/// the exact sum; or "table", the film's table times the light of its lobe, as it is drawn. Throws Error (input).
std::vector<glm::dvec3> film_radiance(const nlohmann::json& material, const std::string& file,
                                      const std::string& method, const lighting::ProbeImage& probe,
                                      const std::vector<diffraction::ShadingPoint>& points);

}  // namespace rowland::trade

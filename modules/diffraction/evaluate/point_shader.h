#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include "modules/diffraction/asset/cooked_material.h"
#include "modules/diffraction/model/grating.h"
#include "modules/diffraction/model/shading_point.h"
#include "modules/diffraction/representations/point_shader.h"

namespace rowland::diffraction {

/// What shades points by a baked material's tables or map, without its key lights; both arguments must outlive it. Maps
/// are filled when they are first needed and kept: a `planar` one for the last plane, so that such a shader is for one
/// thread at a time.
PointShader baked_shader(const CookedMaterial& cooked, const EvaluationLight& light);

/// XYZ of frames by a baked material, as its shaders do it: the tables or the map for what the key lights leave, and
/// `direct` for the key lights. `planar` fills a map for every plane among the frames. Views below the horizon are
/// black.
std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames);

/// The same by a shader of one's own in place of the tables, and `direct` for the key lights.
std::vector<glm::dvec3> evaluate_points(const std::string& title, const PointShader& shader,
                                        const CookedMaterial& cooked, const EvaluationLight& light,
                                        std::span<const ShadingPoint> frames);

/// What shades spikes that are baked for each frame's own view.
PointShader exact_spikes(const Grating& grating, const SpikeSettings& settings, const EvaluationLight& light);

}  // namespace rowland::diffraction

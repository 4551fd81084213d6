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

/// Shades points by a baked material's tables or map, without key lights; both arguments must outlive it. Maps are
/// filled on first use and kept. A sheet that transmits is shaded at lit_from_behind() of its points. `planar` keeps
/// the map of the last plane, so that its shader is for one thread at a time.
PointShader baked_shader(const CookedMaterial& cooked, const EvaluationLight& light);

/// XYZ of points by a baked material, as its shaders compute it: the tables or the map for the residual light, and
/// `direct` for the key lights. `planar` fills a map for every plane among the points. Views below the horizon are
/// black.
std::vector<glm::dvec3> evaluate_baked(const CookedMaterial& cooked, const EvaluationLight& light,
                                       std::span<const ShadingPoint> frames);

/// Adds to such XYZ what the other side of a sheet reflects.
void add_reflected_side(const CookedMaterial& cooked, const EvaluationLight& light,
                        std::span<const ShadingPoint> frames, std::vector<glm::dvec3>& xyz);

/// The same with `shader` instead of the tables, of one side of a sheet.
std::vector<glm::dvec3> evaluate_points(const std::string& title, const PointShader& shader,
                                        const CookedMaterial& cooked, const EvaluationLight& light,
                                        std::span<const ShadingPoint> frames);

/// Shades with spikes that are baked for the view of each point.
PointShader exact_spikes(const Grating& grating, const SpikeSettings& settings, const EvaluationLight& light);

}  // namespace rowland::diffraction

#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::diffraction {

/// The points that an error is measured at: measured_frames(), for ErrorMeasure::HdrFlip those of measured_picture().
std::vector<ShadingPoint> measured_points(ErrorMeasure measure, SurfaceShape surface);

/// An error of XYZ against the reference, with one value per point in both.
using ErrorFunction =
    std::function<double(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference)>;

/// The error at measured_points(); all but ErrorMeasure::HdrFlip take any other points as well.
ErrorFunction error_function(ErrorMeasure measure, SurfaceShape surface);

/// Stops that bring the mean Y of the points that are not black to 0.18.
float exposure_for(std::span<const glm::dvec3> xyz);

/// The smallest of the values that this fraction of them does not exceed; 0 if there are none.
double quantile(std::vector<double> values, double fraction);

}  // namespace rowland::diffraction

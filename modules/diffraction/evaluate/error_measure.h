#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "engine/lighting/probe_image.h"
#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/grating.h"

namespace rowland::diffraction {

/// The relative RMS error √(Σ‖XYZ − reference‖² / Σ‖reference‖²) (PHYSICS §1). 0 where both are black, infinite where
/// only the reference is black. The spans have equal lengths, one value per point.
double relative_rms(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference);

/// The named points, 120 for each shape, that tables of errors are measured at: a compact disc tilted by 35° for flat
/// surfaces; for curved ones a sphere with the grooves along its meridians, down to v_n = 0.1.
std::vector<ShadingPoint> measured_frames(SurfaceShape surface);

/// The pixels of a picture that see a surface.
struct PictureLayout {
    int width = 0;
    int height = 0;
    std::vector<std::size_t> pixels;  ///< of each point: row · width + column, row 0 at the top
};

/// XYZ of a picture's pixels from that of its points; black where it sees no surface.
std::vector<glm::dvec3> picture(const PictureLayout& layout, std::span<const glm::dvec3> radiance);

/// Mean of colour::hdr_flip() over the pixels that see a surface; 0 if none does. The spans have one value per point.
double mean_hdr_flip(const PictureLayout& layout, std::span<const glm::dvec3> radiance,
                     std::span<const glm::dvec3> reference);

/// A picture that errors are measured on, 16 × 16 pixels, and its points: a compact disc tilted by 35° for flat
/// surfaces; for curved ones a sphere with the grooves along its meridians, down to v_n = 0.1. Eye at three radii.
struct MeasuredPicture {
    PictureLayout layout;
    std::vector<ShadingPoint> points;
};
MeasuredPicture measured_picture(SurfaceShape surface);

/// The views of an object in several poses, in parts of one size. An error is the largest of its parts' (PHYSICS §6):
/// one sum over all views would hide those with little light.
struct MeasuredViews {
    GrooveLayout layout;
    std::vector<std::vector<ShadingPoint>> parts;

    std::size_t points() const { return parts.size() * parts.front().size(); }
};

/// Number of parts of drawn_views(). The last one checks a choice that was made by the others.
inline constexpr std::size_t kViewParts = 8;

/// Views drawn at random for a material's error under a probe (quality.measure, quality.surface). Each part has 30 of
/// them, of both sides of the object; a fifth has g as near as possible to a bright texel. For ErrorMeasure::HdrFlip a
/// part is a measured_picture() in a random pose. A flat lattice has one g; on flat grooves g varies as on a disc.
/// Equal gratings and probes give equal views.
MeasuredViews drawn_views(const Material& material, const lighting::ProbeImage& probe);

/// An error of XYZ against the reference, with one value per point in both.
using ErrorFunction =
    std::function<double(std::span<const glm::dvec3> radiance, std::span<const glm::dvec3> reference)>;

/// The error at one part of drawn_views(); all but ErrorMeasure::HdrFlip take any other points as well.
ErrorFunction error_function(ErrorMeasure measure, SurfaceShape surface);

/// Exposure in stops that maps the mean Y of the points that are not black to 0.18.
float exposure_for(std::span<const glm::dvec3> xyz);

/// Quantile: the smallest value that at least `fraction` of the values do not exceed; 0 if there are none.
double quantile(std::vector<double> values, double fraction);

}  // namespace rowland::diffraction

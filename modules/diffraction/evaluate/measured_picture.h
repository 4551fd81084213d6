#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "modules/diffraction/asset/material.h"
#include "modules/diffraction/model/shading_point.h"

namespace rowland::diffraction {

/// The pixels of a picture that see a surface.
struct PictureLayout {
    int width = 0;
    int height = 0;
    std::vector<std::size_t> pixels;  ///< of each point: row · width + column, row 0 at the top
};

/// XYZ of a picture's pixels from that of its points; black where it sees no surface.
std::vector<glm::dvec3> picture(const PictureLayout& layout, std::span<const glm::dvec3> radiance);

/// Mean colour::hdr_flip() over the pixels that see a surface; 0 if none does. The spans have one value per point.
double mean_hdr_flip(const PictureLayout& layout, std::span<const glm::dvec3> radiance,
                     std::span<const glm::dvec3> reference);

/// A picture that errors are measured on, 32 × 32 pixels, and its points: a compact disc tilted by 35° for flat
/// surfaces; for curved ones a sphere with the grooves along its meridians, down to v_n = 0.1. From three radii away.
struct MeasuredPicture {
    PictureLayout layout;
    std::vector<ShadingPoint> points;
};
MeasuredPicture measured_picture(SurfaceShape surface);

}  // namespace rowland::diffraction

#pragma once

#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "modules/diffraction/representations/streak/streak.h"

namespace rowland::diffraction {

/// The kernel's sums over a raster of x.
struct KernelRaster {
    double first_nm = 0.0;  ///< middle of the first interval
    double step_nm = 1.0;
    std::vector<glm::dmat3> sums;  ///< ∫ k dx over each interval

    double middle_nm(std::size_t i) const { return first_nm + static_cast<double>(i) * step_nm; }
};

/// Distance of nodes over their width. At 2 the sum of the nodes' curves has ripples of 1.5 %.
inline constexpr double kNodeDistance = 5.0 / 3.0;

/// The sum of all elements.
double element_sum(const glm::dmat3& matrix);

/// Adds segments without weights over the interval where the kernel is.
void add_segments(const KernelRaster& raster, double distance_nm, std::vector<StreakSegment>& segments);

/// Sets the weights so that the sum of the nodes' normal distributions is next to the kernel.
void fit_weights(std::span<const KernelRaster> rasters, double width_nm, std::vector<StreakSegment>& segments);

}  // namespace rowland::diffraction

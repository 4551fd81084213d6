#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace rowland::lighting {

/// How much an error of a probe's light counts, by its direction s: the mean over surfaces of normal n of
/// max(0, n·s)²/S²(n). S²(n) is the squared signal of the light that such a surface sees. So an error is compared with
/// what is seen beside it: dim light counts where the lamps are below the surface's horizon. A normal counts by
/// (1 + n_y)²/4: surfaces face up more often than down.
class DirectionWeight {
 public:
    /// Light from one direction. Its squared signal on a surface is max(0, n·direction)² times `square`.
    struct Signal {
        glm::dvec3 direction{0.0, 1.0, 0.0};  ///< unit
        double square = 0.0;
    };
    explicit DirectionWeight(std::span<const Signal> signals);

    /// Square root of the weight, continuous; its mean over the sphere is about 1.
    double root(const glm::dvec3& direction) const;

 private:
    std::vector<double> roots_;  ///< at the corners of cells: faces, rows, columns
};

}  // namespace rowland::lighting

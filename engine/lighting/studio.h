#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/image/image.h"

namespace rowland::lighting {

/// A rectangular light, seen from the object it lights.
struct SoftBox {
    double azimuth_deg = 0;     ///< 0 = −Z, 90 = +X
    double elevation_deg = 0;   ///< of its centre above the horizon
    double roll_deg = 0;        ///< turned about its centre, counter-clockwise as the object sees it
    double half_width_deg = 0;  ///< in (0, 80]
    double half_height_deg = 0;
    double soft_edge_deg = 0;  ///< width of the fall-off inside its edge
    glm::dvec3 radiance = {};
};

/// A dark room with soft boxes, on a relative radiance scale, linear Rec.709.
struct StudioRecipe {
    glm::dvec3 ceiling = {};  ///< radiance straight up; blends to `wall` at the horizon
    glm::dvec3 wall = {};
    glm::dvec3 floor = {};  ///< radiance straight down
    std::vector<SoftBox> boxes;
};

/// Equirectangular image of `width` × `width`/2 texels, each the mean of 4 × 4 samples.
image::Image render_studio(const StudioRecipe& recipe, int width);

}  // namespace rowland::lighting

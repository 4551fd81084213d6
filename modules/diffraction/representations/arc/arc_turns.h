#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "engine/lighting/sh_light.h"
#include "modules/diffraction/representations/arc/arc_products.h"

namespace rowland::diffraction {

/// The products of an arc table for every grating vector of one plane. n-band light rotated about the normal is a
/// Fourier series up to n−1 in the azimuth of g, and so are the products.
struct ArcTurns {
    glm::dvec3 e1{1.0, 0.0, 0.0};  ///< azimuth 0 and 90° of g, world axes
    glm::dvec3 e2{0.0, 1.0, 0.0};
    /// The constant, then cos and sin of each multiple, 2n−1 in all; each has the 3·layers() vectors of ArcProducts.
    std::vector<glm::vec4> terms;
};

/// `normal`: unit, in the world. `light` has products.bands().
ArcTurns arc_turns(const ArcProducts& products, const lighting::ShLight& light, const glm::dvec3& normal);

}  // namespace rowland::diffraction

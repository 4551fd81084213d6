#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "modules/diffraction/asset/material.h"

namespace rowland::inspector {

/// The diffraction pattern as a square picture over u = s + v, in the surface (g, h): where the orders send white light
/// of the material's illuminant. Light that is reflected as by a mirror has u = 0.
struct PatternFigure {
    double half_width = 0.0;      ///< it shows |u_g|, |u_h| up to this: all but the faintest orders
    int size = 0;                 ///< texels of a side
    std::vector<glm::dvec3> xyz;  ///< row by row from the smallest u_h; Y has a mean of 1, weighted by itself

    const glm::dvec3& at(double u_g, double u_h) const;
};

/// Of a grating with a lattice. No texels if no order has light.
PatternFigure pattern_figure(const diffraction::Material& material);

}  // namespace rowland::inspector

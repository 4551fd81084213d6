#pragma once

#include <cstddef>

namespace rowland::diffraction {

/// The cost of shading, as counts that depend on the material alone. A fetch reads a texel of four components.
struct ShadingCost {
    int fetches_per_vertex = 0;
    int multiply_adds_per_vertex = 0;
    int fetches_per_pixel = 0;        ///< without analytic and key lights
    int multiply_adds_per_pixel = 0;  ///< likewise
    int fetches_per_light = 0;        ///< per pixel and light that is shaded one by one
    int multiply_adds_per_light = 0;  ///< likewise
    std::size_t table_bytes = 0;      ///< as uploaded; maps that are filled at run time count in full
    std::size_t vertex_bytes = 0;     ///< of light, per vertex
};

}  // namespace rowland::diffraction

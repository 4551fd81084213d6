#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace rowland::diffraction {

/// A grating vector and the directions from which angles around it are counted: CircleMap's e1 and e2.
struct CircleFrame {
    glm::dvec3 g{0.0};
    glm::dvec3 e1{0.0};
    glm::dvec3 e2{0.0};
};

/// The frame of the smallest rotation from +Y, mirrored for the chart of the lower half.
CircleFrame frame_at(const glm::dvec3& g, int chart);

/// Chart coordinates of g: the stereographic map p = (g_x, g_z)/(1 + g_y), mirrored for the lower half; and back.
glm::dvec2 chart_point(const glm::dvec3& g, int chart);
glm::dvec3 grating_vector(const glm::dvec2& p, int chart);

}  // namespace rowland::diffraction

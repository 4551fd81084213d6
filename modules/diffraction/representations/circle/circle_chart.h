#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>

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

/// The symmetries of a cube that keep +Y, which the nodes and the light of circle maps have. s_g of a node and a
/// direction is that of their images, and so is the angle but for angle_image(): both are computed once for all images.
inline constexpr std::size_t kCircleImages = 8;

/// Image 0 is the vector itself; 4 exchanges x and z, then 1 reverses x and 2 reverses z.
template <typename Vector>
Vector circle_image(Vector v, std::size_t image) {
    if ((image & 4) != 0) std::swap(v.x, v.z);
    if ((image & 1) != 0) v.x = -v.x;
    if ((image & 2) != 0) v.z = -v.z;
    return v;
}

/// The angle around a frame's g that becomes t for its image: sign · t + quarters · π/2.
struct AngleImage {
    int sign;
    int quarters;
};
AngleImage angle_image(std::size_t image);

}  // namespace rowland::diffraction

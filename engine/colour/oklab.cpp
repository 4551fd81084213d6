#include "engine/colour/oklab.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

namespace rowland::colour {

namespace {

glm::dmat3 roots_to_oklab() {
    return glm::transpose(glm::dmat3(0.2104542553, 0.7936177850, -0.0040720468,  //
                                     1.9779984951, -2.4285922050, 0.4505937099,  //
                                     0.0259040371, 0.7827717662, -0.8086757660));
}

}  // namespace

glm::dmat3 rec709_to_oklab_lms() {
    return glm::transpose(glm::dmat3(0.4122214708, 0.5363325363, 0.0514459929,  //
                                     0.2119034982, 0.6806995451, 0.1073969566,  //
                                     0.0883024619, 0.2817188376, 0.6299787005));
}

glm::dvec3 oklab_of_lms(const glm::dvec3& lms) {
    static const glm::dmat3 matrix = roots_to_oklab();
    return matrix * glm::dvec3(std::cbrt(lms.x), std::cbrt(lms.y), std::cbrt(lms.z));
}

glm::dvec3 oklab_to_lms(const glm::dvec3& oklab) {
    static const glm::dmat3 matrix = glm::inverse(roots_to_oklab());
    const glm::dvec3 roots = matrix * oklab;
    return roots * roots * roots;
}

double oklab_hue_difference_deg(const glm::dvec3& oklab_1, const glm::dvec3& oklab_2) {
    const glm::dvec2 first(oklab_1.y, oklab_1.z);
    const glm::dvec2 second(oklab_2.y, oklab_2.z);
    const double sine = first.x * second.y - first.y * second.x;
    return glm::degrees(std::abs(std::atan2(sine, glm::dot(first, second))));
}

}  // namespace rowland::colour

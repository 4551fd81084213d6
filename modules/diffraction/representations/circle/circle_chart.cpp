#include "modules/diffraction/representations/circle/circle_chart.h"

#include <glm/geometric.hpp>

namespace rowland::diffraction {

namespace {

glm::dvec3 mirrored(const glm::dvec3& v, int chart) {
    return chart == 0 ? v : glm::dvec3(v.x, -v.y, v.z);
}

}  // namespace

CircleFrame frame_at(const glm::dvec3& g, int chart) {
    const glm::dvec3 up = mirrored(g, chart);
    const glm::dvec3 turn = up + glm::dvec3(0.0, 1.0, 0.0);
    const double scale = 1.0 / (1.0 + up.y);
    return {g, mirrored(glm::dvec3(1.0, 0.0, 0.0) - up.x * scale * turn, chart),
            mirrored(glm::dvec3(0.0, 0.0, 1.0) - up.z * scale * turn, chart)};
}

glm::dvec2 chart_point(const glm::dvec3& g, int chart) {
    const glm::dvec3 up = mirrored(g, chart);
    return glm::dvec2(up.x, up.z) / (1.0 + up.y);
}

AngleImage angle_image(std::size_t image) {
    AngleImage angle{1, 0};
    const auto reflect = [&](int quarters) { angle = {-angle.sign, quarters - angle.quarters}; };
    if ((image & 4) != 0) reflect(1);
    if ((image & 1) != 0) reflect(2);
    if ((image & 2) != 0) reflect(0);
    return angle;
}

glm::dvec3 grating_vector(const glm::dvec2& p, int chart) {
    const double square = glm::dot(p, p);
    return mirrored(glm::dvec3(2.0 * p.x, 1.0 - square, 2.0 * p.y) / (1.0 + square), chart);
}

}  // namespace rowland::diffraction

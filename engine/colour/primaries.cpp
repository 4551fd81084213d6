#include "engine/colour/primaries.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace rowland::colour {

namespace {

bool nearly_equal(const glm::dvec2& a, const glm::dvec2& b) {
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) < 1e-3;
}

}  // namespace

glm::dvec3 xy_to_xyz(const glm::dvec2& xy) {
    return {xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y};
}

glm::dmat3 rgb_to_xyz(const Primaries& p, const glm::dvec3& white) {
    // x, y, z rather than XYZ / Y: a primary may have no luminance (the blue of ACES AP0 has a negative one).
    const auto column = [](const glm::dvec2& xy) { return glm::dvec3(xy.x, xy.y, 1 - xy.x - xy.y); };
    const glm::dmat3 columns(column(p.red), column(p.green), column(p.blue));
    const glm::dvec3 scale = glm::inverse(columns) * white;
    return {columns[0] * scale.x, columns[1] * scale.y, columns[2] * scale.z};
}

glm::dmat3 bradford(const glm::dvec3& from_white, const glm::dvec3& to_white) {
    const glm::dmat3 cones =
        glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 gain = (cones * to_white) / (cones * from_white);
    const glm::dmat3 scale(gain.x, 0, 0, 0, gain.y, 0, 0, 0, gain.z);
    return glm::inverse(cones) * scale * cones;
}

bool is_usable(const Primaries& p) {
    for (const glm::dvec2& xy : {p.red, p.green, p.blue, p.white})
        if (!(std::abs(xy.x) <= 2 && std::abs(xy.y) <= 2)) return false;
    const glm::dvec2 a = p.green - p.red;
    const glm::dvec2 b = p.blue - p.red;
    return std::abs(a.x * b.y - a.y * b.x) > 1e-3 && p.white.y > 1e-3;
}

std::optional<glm::dmat3> to_rec709(const Primaries& from) {
    const bool same = nearly_equal(from.red, kRec709.red) && nearly_equal(from.green, kRec709.green) &&
                      nearly_equal(from.blue, kRec709.blue) && nearly_equal(from.white, kRec709.white);
    if (same || !is_usable(from)) return std::nullopt;
    const glm::dvec3 white = xy_to_xyz(from.white);
    return xyz_to_rec709() * bradford(white, xy_to_xyz(kRec709.white)) * rgb_to_xyz(from, white);
}

glm::dmat3 xyz_to_rec709() {
    return glm::inverse(rgb_to_xyz(kRec709, xy_to_xyz(kRec709.white)));
}

}  // namespace rowland::colour

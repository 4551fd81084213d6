#include "engine/colour/colour_space.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/glm.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

#include "engine/colour/illuminant.h"

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

namespace {

constexpr Primaries kAcesCg{{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}};

}  // namespace

glm::dvec3 white_d65() {
    static const glm::dvec3 white = [] {
        const glm::dvec3 xyz = rgb_to_xyz(LightSpectra(), glm::dvec3(1.0));
        return xyz / xyz.y;
    }();
    return white;
}

glm::dmat3 rec709_to_xyz() {
    static const glm::dmat3 matrix = rgb_to_xyz(kRec709, white_d65());
    return matrix;
}

glm::dmat3 xyz_to_acescg() {
    static const glm::dmat3 matrix = [] {
        const glm::dvec3 d60 = xy_to_xyz(kAcesCg.white);
        return glm::inverse(rgb_to_xyz(kAcesCg, d60)) * bradford(white_d65(), d60);
    }();
    return matrix;
}

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

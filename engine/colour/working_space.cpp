#include "engine/colour/working_space.h"

#include <array>
#include <glm/matrix.hpp>

#include "engine/colour/light_spectra.h"

namespace rowland::colour {

namespace {

/// XYZ of a chromaticity (x, y), Y = 1.
glm::dvec3 from_chromaticity(double x, double y) {
    return {x / y, 1.0, (1.0 - x - y) / y};
}

/// RGB → XYZ of the primaries with the given white: each primary scaled so that (1,1,1) is the white.
glm::dmat3 primaries_to_xyz(const std::array<glm::dvec3, 3>& primaries, const glm::dvec3& white) {
    const glm::dmat3 unscaled(primaries[0], primaries[1], primaries[2]);
    const glm::dvec3 scale = glm::inverse(unscaled) * white;
    return {scale.r * primaries[0], scale.g * primaries[1], scale.b * primaries[2]};
}

/// Chromatic adaptation by scaling in Bradford's cone space (Lam 1985; ICC.1, annex E).
glm::dmat3 bradford(const glm::dvec3& from_white, const glm::dvec3& to_white) {
    const glm::dmat3 cones =
        glm::transpose(glm::dmat3(0.8951, 0.2664, -0.1614, -0.7502, 1.7135, 0.0367, 0.0389, -0.0685, 1.0296));
    const glm::dvec3 gain = (cones * to_white) / (cones * from_white);
    const glm::dmat3 scale(gain.x, 0.0, 0.0, 0.0, gain.y, 0.0, 0.0, 0.0, gain.z);
    return glm::inverse(cones) * scale * cones;
}

}  // namespace

glm::dvec3 white_d65() {
    static const glm::dvec3 white = [] {
        const glm::dvec3 xyz = rgb_to_xyz(LightSpectra(), glm::dvec3(1.0));
        return xyz / xyz.y;
    }();
    return white;
}

glm::dmat3 rec709_to_xyz() {
    static const glm::dmat3 matrix = primaries_to_xyz(
        {from_chromaticity(0.64, 0.33), from_chromaticity(0.30, 0.60), from_chromaticity(0.15, 0.06)}, white_d65());
    return matrix;
}

glm::dmat3 xyz_to_acescg() {
    static const glm::dmat3 matrix = [] {
        const glm::dvec3 d60 = from_chromaticity(0.32168, 0.33767);
        const glm::dmat3 ap1_to_xyz = primaries_to_xyz(
            {from_chromaticity(0.713, 0.293), from_chromaticity(0.165, 0.830), from_chromaticity(0.128, 0.044)}, d60);
        return glm::inverse(ap1_to_xyz) * bradford(white_d65(), d60);
    }();
    return matrix;
}

glm::dmat3 rec709_to_acescg() {
    static const glm::dmat3 matrix = xyz_to_acescg() * rec709_to_xyz();
    return matrix;
}

}  // namespace rowland::colour

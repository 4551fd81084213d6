#include "engine/colour/working_space.h"

#include <glm/matrix.hpp>

#include "engine/colour/light_spectra.h"
#include "engine/colour/primaries.h"

namespace rowland::colour {

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

}  // namespace rowland::colour

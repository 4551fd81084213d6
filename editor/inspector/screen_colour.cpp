#include "editor/inspector/screen_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "engine/colour/observer.h"
#include "engine/colour/working_space.h"

namespace rowland::inspector {

namespace {

/// IEC 61966-2-1.
float encoded(double linear) {
    const double x = std::clamp(linear, 0.0, 1.0);
    return static_cast<float>(x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055);
}

glm::dvec3 in_gamut(const glm::dvec3& xyz) {
    static const glm::dmat3 to_rgb = glm::inverse(colour::rec709_to_xyz());
    glm::dvec3 rgb = to_rgb * xyz;
    rgb -= std::min(0.0, std::min({rgb.r, rgb.g, rgb.b}));
    return rgb;
}

}  // namespace

glm::vec3 screen_colour(const glm::dvec3& xyz) {
    glm::dvec3 rgb = in_gamut(xyz);
    rgb /= std::max(1.0, std::max({rgb.r, rgb.g, rgb.b}));
    return {encoded(rgb.r), encoded(rgb.g), encoded(rgb.b)};
}

ImU32 screen_colour_u32(const glm::dvec3& xyz, float alpha) {
    const glm::vec3 rgb = screen_colour(xyz);
    return ImGui::ColorConvertFloat4ToU32({rgb.r, rgb.g, rgb.b, alpha});
}

ImU32 wavelength_colour(double wavelength_nm, float alpha) {
    const glm::dvec3 rgb = in_gamut(colour::cie_xyz(wavelength_nm));
    const double brightest = std::max({rgb.r, rgb.g, rgb.b, 1e-9});
    // The ends of the range fade as the eye's sensitivity does, but stay to be seen.
    const double fade = std::clamp(std::pow(brightest, 0.4), 0.25, 1.0);
    return ImGui::ColorConvertFloat4ToU32({encoded(fade * rgb.r / brightest), encoded(fade * rgb.g / brightest),
                                           encoded(fade * rgb.b / brightest), alpha});
}

}  // namespace rowland::inspector

#include "editor/inspector/screen_colour.h"

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "engine/colour/observer.h"
#include "engine/colour/srgb.h"
#include "engine/colour/working_space.h"

namespace rowland::inspector {

namespace {

glm::vec3 encoded(const glm::dvec3& linear) {
    glm::vec3 result;
    for (int i = 0; i < 3; ++i) result[i] = static_cast<float>(colour::srgb_encoded(std::clamp(linear[i], 0.0, 1.0)));
    return result;
}

ImU32 packed(const glm::vec3& rgb, float alpha) {
    return ImGui::ColorConvertFloat4ToU32({rgb.r, rgb.g, rgb.b, alpha});
}

glm::dvec3 in_gamut(const glm::dvec3& xyz) {
    static const glm::dmat3 to_rgb = glm::inverse(colour::rec709_to_xyz());
    const glm::dvec3 rgb = to_rgb * xyz;
    return rgb - std::min({0.0, rgb.r, rgb.g, rgb.b});
}

}  // namespace

glm::vec3 screen_colour(const glm::dvec3& xyz) {
    const glm::dvec3 rgb = in_gamut(xyz);
    return encoded(rgb / std::max({1.0, rgb.r, rgb.g, rgb.b}));
}

ImU32 screen_colour_u32(const glm::dvec3& xyz) {
    return packed(screen_colour(xyz), 1.0F);
}

ImU32 wavelength_colour(double wavelength_nm, float alpha) {
    const glm::dvec3 rgb = in_gamut(colour::cie_xyz(wavelength_nm));
    const double brightest = std::max({rgb.r, rgb.g, rgb.b, 1e-9});
    // The ends of the spectrum fade with the eye's sensitivity, but stay visible.
    const double fade = std::clamp(std::pow(brightest, 0.4), 0.25, 1.0);
    return packed(encoded(fade / brightest * rgb), alpha);
}

}  // namespace rowland::inspector
